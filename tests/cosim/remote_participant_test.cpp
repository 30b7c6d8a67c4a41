#include "cosim/remote_participant.hpp"

#include <atomic>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/memory_transport.hpp"
#include "cosim/serve.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/spring_run.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing_support::SpringParticipant;
using testing_support::SpringRun;
using testing_support::wordsOf;

constexpr SimDuration kStepLength{1'000'000};

RemoteOptions remoteOptions() {
  RemoteOptions options;
  options.name = "plant";
  options.config_digest = 1;
  options.patience = milliseconds{300};
  options.first_patience = milliseconds{300};
  return options;
}

/// A spring served in a thread of its own.
class ServedSpring {
 public:
  explicit ServedSpring(ServeOptions options = {}) {
    auto [here, there] = makeMemoryLink();
    master_end = std::move(here);
    far_end_ = std::move(there);
    if (options.config_digest == 0) options.config_digest = 1;
    options.stop = &stop;
    thread_ = std::thread([this, options] {
      try {
        report = serve(spring, *far_end_, options);
      } catch (const Error& error) {
        lost = error.what();
      }
    });
  }
  ~ServedSpring() { join(); }
  void join() {
    if (!thread_.joinable()) return;
    thread_.join();
  }

  SpringParticipant spring;
  std::unique_ptr<Transport> master_end;
  std::atomic<bool> stop{false};
  ServeReport report;  // these two after join()
  std::string lost;

 private:
  std::unique_ptr<Transport> far_end_;
  std::thread thread_;
};

TEST(RemoteParticipant, IsSteppedLikeALocalOneWithTheSameResult) {
  SpringParticipant local;
  Lifecycle guarded(local);
  const std::string expected = SpringRun(guarded).finish();

  ServedSpring served;
  RemoteParticipant remote(*served.master_end, remoteOptions());
  EXPECT_EQ(SpringRun(remote).finish(), expected);
  served.join();
  EXPECT_EQ(served.report.end, ServeEnd::kFinished);
  // hello, one request per step, bye
  EXPECT_EQ(served.report.served, served.spring.stepsDone() + 2);
  EXPECT_EQ(remote.statistics().requests, served.report.served);
}

TEST(RemoteParticipant, NamesWhoIsSilentAndWhatToTry) {
  auto [master_end, nobody] = makeMemoryLink();
  RemoteParticipant remote(*master_end, remoteOptions());
  try {
    remote.enterInitializationMode(kSimStart);
    FAIL() << "no error";
  } catch (const LostParticipantError& error) {
    EXPECT_EQ(error.participant(), "plant");
    EXPECT_THAT(error.what(), testing::MatchesRegex(
                                  "no reply from 'plant' within [0-9]+ ms \\([0-9]+ tries of "
                                  "request 1\\), on memory of this process. Is it running, and on "
                                  "the same LCM URL\\? Try: ballbot doctor"));
  }
}

TEST(RemoteParticipant, SaysWhenAnotherRunIsOnTheChannel) {
  auto [master_end, other] = makeMemoryLink();
  ballbot_msgs::step_reply reply{};
  reply.header.session = 4711;
  Bytes bytes;
  encodeMessage(reply, bytes);
  other->send(bytes.data(), bytes.size());
  RemoteParticipant remote(*master_end, remoteOptions());
  EXPECT_THAT(wordsOf<LostParticipantError>([&] { remote.enterInitializationMode(kSimStart); }),
              HasSubstr("1 messages of another run came instead: is the channel in use twice?"));
}

TEST(RemoteParticipant, ADeadProcessIsReportedAtOnce) {
  auto [master_end, nobody] = makeMemoryLink();
  RemoteOptions options = remoteOptions();
  options.first_patience = std::chrono::hours{1};
  options.peer_trouble = [] { return "exited with code 2"; };
  RemoteParticipant remote(*master_end, options);
  EXPECT_EQ(wordsOf<LostParticipantError>([&] { remote.enterInitializationMode(kSimStart); }),
            "plant exited with code 2");
}

TEST(RemoteParticipant, CtrlCEndsTheWaiting) {
  auto [master_end, nobody] = makeMemoryLink();
  RemoteOptions options = remoteOptions();
  options.first_patience = std::chrono::hours{1};
  std::atomic<bool> stop{true};
  options.stop = &stop;
  RemoteParticipant remote(*master_end, options);
  EXPECT_EQ(wordsOf<InterruptedError>([&] { remote.enterInitializationMode(kSimStart); }),
            "stopped while waiting for plant");
}

TEST(RemoteParticipant, ARefusalIsAnInputErrorInTheWordsOfTheFarEnd) {
  ServeOptions other_config;
  other_config.config_digest = 2;
  other_config.first_contact = milliseconds{400};
  ServedSpring served(other_config);
  RemoteParticipant remote(*served.master_end, remoteOptions());
  EXPECT_THAT(wordsOf<InputError>([&] { remote.enterInitializationMode(kSimStart); }),
              HasSubstr("spring runs configuration 0000000000000002, its master 0000000000000001"));
}

TEST(RemoteParticipant, AFailureFarAwayIsALostParticipantAndTheFarEndIsReleased) {
  ServedSpring served;
  {
    RemoteParticipant remote(*served.master_end, remoteOptions());
    remote.enterInitializationMode(kSimStart);
    served.spring.failAt(kSimStart + 2 * kStepLength);
    remote.doStep(kSimStart, kStepLength, {});
    EXPECT_EQ(wordsOf<LostParticipantError>(
                  [&] { remote.doStep(kSimStart + kStepLength, kStepLength, {}); }),
              "spring: broke at 0.002000 s");
  }
  served.join();
  EXPECT_EQ(served.report.end, ServeEnd::kAborted);
}

TEST(RemoteParticipant, BadInputFarAwayIsBadInputHere) {
  ServedSpring served;
  RemoteParticipant remote(*served.master_end, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  EXPECT_THAT(wordsOf<InputError>([&] { remote.restoreState(StateBlob(100, 7)); }),
              HasSubstr("are not a saved participant state"));
}

TEST(RemoteParticipant, SavedStatesOfLocalAndRemoteParticipantsAreTheSame) {
  SpringParticipant spring;
  Lifecycle local(spring);
  local.enterInitializationMode(kSimStart);
  local.exitInitializationMode();
  spring.carry(3000);
  local.doStep(kSimStart, kStepLength, {});

  ServedSpring served;
  RemoteParticipant remote(*served.master_end, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  remote.exitInitializationMode();
  remote.restoreState(local.saveState());
  EXPECT_EQ(remote.sensors().time, kSimStart + kStepLength);
  EXPECT_EQ(remote.stateDigest(), local.stateDigest());
  served.spring.carry(3000);
  EXPECT_EQ(remote.saveState(), local.saveState());
}

TEST(RemoteParticipant, ResetStartsAgainInTheSameSession) {
  ServedSpring served;
  RemoteParticipant remote(*served.master_end, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  const std::uint64_t digest = remote.stateDigest();
  remote.doStep(kSimStart, kStepLength, {});
  remote.reset();
  remote.enterInitializationMode(kSimStart);
  EXPECT_EQ(remote.stateDigest(), digest);
  remote.terminate();
  served.join();
  EXPECT_EQ(served.report.served, 4);  // hello, step, reset, bye
}

TEST(Serve, AMasterThatGoesSilentIsLost) {
  ServeOptions options;
  options.idle_timeout = milliseconds{250};
  ServedSpring served(options);
  RemoteParticipant remote(*served.master_end, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  served.join();
  EXPECT_THAT(served.lost, HasSubstr("spring: no request from the controller for 250 ms, at "
                                     "0.000000 s, on memory of this process"));
}

TEST(Serve, OtherTrafficIsNoSignOfLife) {
  ServeOptions options;
  options.first_contact = milliseconds{300};
  ServedSpring served(options);
  std::atomic<bool> stop{false};
  std::thread noise([&] {
    const Bytes junk(64, 3);
    while (!stop) {
      served.master_end->send(junk.data(), junk.size());
      std::this_thread::sleep_for(milliseconds{20});
    }
  });
  served.join();
  stop = true;
  noise.join();
  EXPECT_THAT(served.lost, HasSubstr("no request from the controller for 300 ms"));
}

TEST(Serve, CtrlCTellsTheMasterWhyNoReplyWillCome) {
  ServedSpring served;
  RemoteParticipant remote(*served.master_end, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  served.stop = true;
  const std::string words = wordsOf<LostParticipantError>([&] {
    for (SimTime t = kSimStart;; t += kStepLength) remote.doStep(t, kStepLength, {});
  });
  EXPECT_EQ(words, "spring was stopped by a signal");
  served.join();
  EXPECT_EQ(served.report.end, ServeEnd::kInterrupted);
}

TEST(Serve, ServesRunAfterRunWhenAsked) {
  ServeOptions options;
  options.keep_serving = true;
  options.linger = milliseconds{1};
  ServedSpring served(options);
  std::string digests[2];
  for (std::string& digest : digests) {
    RemoteParticipant remote(*served.master_end, remoteOptions());
    digest = SpringRun(remote).finish();
  }
  EXPECT_EQ(digests[0], digests[1]);
  served.stop = true;
}

TEST(Serve, WhoServesIsAnsweredWithTheName) {
  ServedSpring served;
  EXPECT_EQ(whoServes(*served.master_end, milliseconds{500}), "spring");
  served.stop = true;
  auto [lonely, nobody] = makeMemoryLink();
  EXPECT_EQ(whoServes(*lonely, milliseconds{20}), std::nullopt);
}

/// Loses the first message that is sent.
class LossyTransport final : public Transport {
 public:
  explicit LossyTransport(Transport& inner) : inner_(inner) {}
  void send(const std::uint8_t* data, std::size_t size) override {
    if (++sent_ > 1) inner_.send(data, size);
  }
  bool receive(Bytes& out, WallDuration timeout) override { return inner_.receive(out, timeout); }
  std::string describe() const override { return inner_.describe(); }

 private:
  Transport& inner_;
  int sent_ = 0;
};

TEST(Serve, WhoServesAsksAgainWhenTheQuestionIsLost) {
  ServedSpring served;
  LossyTransport lossy(*served.master_end);
  EXPECT_EQ(whoServes(lossy, std::chrono::seconds{20}), "spring");
  served.stop = true;
}

TEST(RetransmissionTimer, FollowsTheRoundTripAndBacksOff) {
  RetransmissionTimer timer;
  for (int i = 0; i < 100; ++i) timer.measured(milliseconds{10});
  EXPECT_GE(timer.wait(0), milliseconds{10});
  EXPECT_LE(timer.wait(0), milliseconds{12});
  EXPECT_EQ(timer.wait(1), timer.wait(0));
  EXPECT_EQ(timer.wait(2), 2 * timer.wait(0));
  EXPECT_EQ(timer.wait(30), RetransmissionTimer::kLongest);
  for (int i = 0; i < 100; ++i) timer.measured(std::chrono::microseconds{20});
  EXPECT_EQ(timer.wait(0), RetransmissionTimer::kShortest);
}

}  // namespace
}  // namespace ballbot
