#include "cosim/serve.hpp"

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/memory_transport.hpp"
#include "cosim/remote_participant.hpp"
#include "cosim/step_server.hpp"
#include "tests/cosim/support/served_spring.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/spring_run.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing_support::kStepLength;
using testing_support::remoteOptions;
using testing_support::ServedSpring;
using testing_support::SpringParticipant;
using testing_support::SpringRun;
using testing_support::wordsOf;

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

}  // namespace
}  // namespace ballbot
