#include "hil/slcan_bus.hpp"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "hil/emulator/pty_bus.hpp"
#include "hil/open_can_bus.hpp"
#include "tests/hil/support/random_bytes.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

template <typename Call>
std::string errorOf(Call&& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

/// An adapter that answers from a thread of its own, as a real one does.
class LiveAdapter {
 public:
  explicit LiveAdapter(bool flexible = false) : bus_("", flexible), thread_([this] { run(); }) {}
  ~LiveAdapter() {
    stop_ = true;
    thread_.join();
  }
  PtyBus& bus() { return bus_; }

 private:
  // Sends every frame back.
  void run() {
    CanFrame frame;
    while (!stop_) {
      bus_.waitReadable(milliseconds(5));
      while (bus_.receive(frame)) bus_.send(frame);
    }
  }
  PtyBus bus_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// A bare end of a pseudo terminal that says heartbeats until it is told C, like an adapter whose
/// channel a host left open when it died.
class TalkingAdapter {
 public:
  TalkingAdapter() : end_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    ::grantpt(end_);
    ::unlockpt(end_);
    path_ = ::ptsname(end_);
    ::fcntl(end_, F_SETFL, O_NONBLOCK);
    thread_ = std::thread([this] { run(); });
  }
  ~TalkingAdapter() {
    stop_ = true;
    thread_.join();
    ::close(end_);
  }
  const std::string& path() const { return path_; }

 private:
  void run() {
    bool open = true;
    while (!stop_) {
      char c = 0;
      bool command = false;
      while (::read(end_, &c, 1) == 1) {
        if (c == 'C') open = false;
        command = command || c == 'C' || c == 'S' || c == 'O';
        if (c == '\r' && command) say("\r");
        if (c == '\r') command = false;
      }
      if (open) say("t70117F\r");
      std::this_thread::sleep_for(milliseconds(2));
    }
  }
  void say(const char* text) { (void)!::write(end_, text, std::strlen(text)); }

  int end_;
  std::string path_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST(SlcanBus, OpensAChannelThatADeadHostLeftOpen) {
  TalkingAdapter adapter;
  const auto begin = std::chrono::steady_clock::now();
  const SlcanBus bus(adapter.path(), {1000});
  EXPECT_TRUE(bus.isUp());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(SlcanBus, CarriesFramesOfAllKindsThereAndBack) {
  LiveAdapter adapter;
  SlcanBus bus(adapter.bus().path(), {1000});
  RandomBytes random(4);
  for (int i = 0; i < 2000; ++i) {
    const CanFrame frame = random.frame();
    ASSERT_TRUE(bus.send(frame));
    CanFrame back;
    for (int tries = 0; !bus.receive(back); ++tries) {
      ASSERT_LT(tries, 100);
      bus.waitReadable(milliseconds(50));
    }
    ASSERT_EQ(back, frame);
  }
  EXPECT_EQ(bus.counters().sent, 2000);
  EXPECT_EQ(bus.counters().received, 2000);
  EXPECT_EQ(bus.counters().malformed, 0);
  EXPECT_TRUE(bus.isUp());
}

TEST(SlcanBus, CarriesCanFdWhereTheAdapterHasIt) {
  CanBusSettings fd;
  fd.data_bitrate_kbps = 5000;
  LiveAdapter adapter(true), classic;
  SlcanBus bus(adapter.bus().path(), fd);
  EXPECT_THAT(bus.describe(), HasSubstr("1000 kbit/s, CAN FD at 5000 kbit/s"));
  RandomBytes random(5);
  for (int i = 0; i < 500; ++i) {
    const CanFrame frame = i % 4 == 0 ? random.frame() : random.flexibleFrame();
    ASSERT_TRUE(bus.send(frame));
    CanFrame back;
    for (int tries = 0; !bus.receive(back); ++tries) {
      ASSERT_LT(tries, 100);
      bus.waitReadable(milliseconds(50));
    }
    ASSERT_EQ(back, frame);
  }
  EXPECT_THAT(errorOf([&] { SlcanBus other(classic.bus().path(), fd); }),
              HasSubstr("the adapter refuses 'Y5', so it has no CAN FD at that data bit rate"));
  fd.data_bitrate_kbps = 1500;
  EXPECT_THAT(errorOf([&] { SlcanBus other(classic.bus().path(), fd); }),
              HasSubstr("CAN FD data at 1500 kbit/s; slcan adapters have whole Mbit/s, 1 to 8"));
}

TEST(SlcanBus, RefusesASecondMasterOnTheSameDevice) {
  LiveAdapter adapter;
  SlcanBus bus(adapter.bus().path(), {1000});
  EXPECT_THAT(errorOf([&] { SlcanBus second(adapter.bus().path(), {1000}); }),
              HasSubstr("is in use by another process. End that one first"));
}

TEST(SlcanBus, SaysWhatIsWrongWithADevice) {
  EXPECT_THAT(errorOf([] { SlcanBus bus("/no/such/tty", {1000}); }),
              HasSubstr("/no/such/tty: cannot be opened: No such file or directory. Is the adapter "
                        "plugged in"));
  EXPECT_THAT(errorOf([] { SlcanBus bus("/dev/null", {1000}); }), HasSubstr("is no serial device"));
  EXPECT_THAT(errorOf([] { SlcanBus bus("/dev/null", {123}); }),
              HasSubstr("123 kbit/s is no rate of slcan adapters; take 10,"));
  PtyBus mute("");  // nobody answers
  EXPECT_THAT(errorOf([&] { SlcanBus bus(mute.path(), {1000}); }),
              HasSubstr("no answer to 'C' within 1000 ms"));
}

TEST(SlcanBus, WorksWithAnAdapterThatAcknowledgesNothing) {
  PtyBus mute("");
  CanBusSettings settings;
  settings.acknowledges = false;
  SlcanBus bus(mute.path(), settings);
  EXPECT_THAT(bus.describe(), HasSubstr("an adapter that acknowledges nothing"));
  CanFrame frame;
  mute.receive(frame);  // the commands, late
  EXPECT_TRUE(mute.adapter().isOpen());
  mute.send({0x181, false, false, 1, {7}});
  ASSERT_TRUE(bus.waitReadable(milliseconds(500)));
  while (!bus.receive(frame)) ASSERT_TRUE(bus.waitReadable(milliseconds(500)));
  EXPECT_EQ(frame.id, 0x181U);
}

TEST(SlcanBus, KnowsWhenTheDeviceIsGone) {
  auto adapter = std::make_unique<LiveAdapter>();
  SlcanBus bus(adapter->bus().path(), {1000});
  adapter.reset();
  CanFrame frame;
  bus.receive(frame);
  EXPECT_FALSE(bus.isUp());
  EXPECT_FALSE(bus.send({1, false, false, 0, {}}));
  EXPECT_EQ(bus.counters().refused, 1);
}

TEST(PtyBus, MakesALinkAndTakesItAway) {
  const std::string link = ::testing::TempDir() + "ballbot_pty_" + std::to_string(::getpid());
  {
    PtyBus bus(link);
    EXPECT_EQ(bus.path(), link);
    EXPECT_EQ(::access(link.c_str(), R_OK | W_OK), 0);
  }
  EXPECT_NE(::access(link.c_str(), F_OK), 0);
  EXPECT_THAT(errorOf([] { PtyBus bus("/dev/null"); }), HasSubstr("is no symbolic link"));
}

TEST(PtyBus, RefusesALinkThatAnotherOneServes) {
  const std::string link = ::testing::TempDir() + "ballbot_pty_taken_" + std::to_string(::getpid());
  {
    PtyBus first(link);
    EXPECT_THAT(errorOf([&] { PtyBus second(link); }),
                HasSubstr(link + ": another `ballbot drives` (process " +
                          std::to_string(::getpid()) + ") serves this link. End that one first"));
    EXPECT_EQ(::access(link.c_str(), R_OK | W_OK), 0) << "the first one's link is still there";
  }
  PtyBus third(link);
  EXPECT_EQ(::access((link + ".lock").c_str(), F_OK), 0);
}

TEST(PtyBus, ReplacesALinkThatSomebodyLeftBehind) {
  const std::string link = ::testing::TempDir() + "ballbot_pty_left_" + std::to_string(::getpid());
  ASSERT_EQ(::symlink("/dev/pts/no-such", link.c_str()), 0);
  PtyBus bus(link);
  EXPECT_EQ(::access(link.c_str(), R_OK | W_OK), 0);
}

TEST(OpenCanBus, NamesTheTwoKinds) {
  EXPECT_THAT(errorOf([] { openCanBus("can0"); }),
              HasSubstr("CAN bus 'can0' must be slcan:DEVICE"));
  EXPECT_THAT(errorOf([] { openCanBus("slcan:"); }), HasSubstr("or socketcan:INTERFACE"));
}

}  // namespace
}  // namespace ballbot
