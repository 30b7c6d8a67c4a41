#include "cosim/remote_participant.hpp"

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
#include "cosim/serve.hpp"
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

// Set-up of drives that answer slowly takes longer than a master waits in silence.
TEST(RemoteParticipant, WaitsForWhoeverSaysThatItIsStillSettingUp) {
  struct SlowStarter : SpringParticipant {
    BusySignal busy;
    milliseconds then_silent{0};
    void enterInitializationMode(SimTime start) override {
      for (int i = 0; i < 7; ++i) {
        std::this_thread::sleep_for(milliseconds{200});
        busy.tell("still setting up, node 4: 12 of 61");
      }
      std::this_thread::sleep_for(then_silent);
      SpringParticipant::enterInitializationMode(start);
    }
  };
  for (const bool dies : {false, true}) {
    auto [master_end, far_end] = makeMemoryLink();
    SlowStarter spring;
    if (dies) spring.then_silent = milliseconds{1500};
    ServeOptions serving;
    serving.config_digest = 1;
    serving.busy = &spring.busy;
    std::thread server([&, end = far_end.get()] { serve(spring, *end, serving); });
    RemoteOptions options = remoteOptions();
    options.first_patience = milliseconds{900};
    std::string said;
    options.say = [&](const std::string& text) { said = text; };
    {
      RemoteParticipant remote(*master_end, options);
      if (dies) {
        const std::string words =
            wordsOf<LostParticipantError>([&] { remote.enterInitializationMode(kSimStart); });
        EXPECT_THAT(words, HasSubstr("The last it said: spring: still setting up, node 4"));
      } else {
        remote.enterInitializationMode(kSimStart);
        EXPECT_EQ(said, "spring: still setting up, node 4: 12 of 61");
        remote.terminate();
      }
      if (dies) std::this_thread::sleep_for(milliseconds{1600});  // then it hears the abort
    }
    server.join();
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

TEST(RemoteParticipant, AFailureFarAwayIsThatFailureHereAndTheFarEndIsReleased) {
  ServedSpring served;
  {
    RemoteParticipant remote(*served.master_end, remoteOptions());
    remote.enterInitializationMode(kSimStart);
    served.spring.failAt(kSimStart + 2 * kStepLength);
    remote.doStep(kSimStart, kStepLength, {});
    EXPECT_EQ(wordsOf<InputError>([&] { remote.doStep(kSimStart + kStepLength, kStepLength, {}); }),
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

/// A far end whose replies to steps are changed on the way, with good checksums.
class ChangingTransport final : public Transport {
 public:
  using Change = std::function<void(ballbot_msgs::step_reply&)>;
  explicit ChangingTransport(Change change) : change_(std::move(change)) {}

  void send(const std::uint8_t* data, std::size_t size) override {
    const Bytes* answer = server_.receive(data, size);
    waiting_ = answer != nullptr;
    if (!waiting_) return;
    ballbot_msgs::step_reply reply{};
    ASSERT_TRUE(decodeMessage(answer->data(), answer->size(), reply));
    using Header = ballbot_msgs::step_header;
    if (reply.header.kind == Header::STEP || reply.header.kind == Header::SAVE) change_(reply);
    encodeMessage(reply, next_);
  }
  bool receive(Bytes& out, WallDuration) override {
    if (!std::exchange(waiting_, false)) return false;
    out = next_;
    return true;
  }
  std::string describe() const override { return "a test"; }

 private:
  Change change_;
  SpringParticipant spring_;
  StepServer server_{spring_, 1, 9};
  bool waiting_ = false;
  Bytes next_;
};

/// What the master says to a reply to its first step that is changed so.
std::string wordsOfStep(ChangingTransport::Change change) {
  ChangingTransport transport(std::move(change));
  RemoteParticipant remote(transport, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  return wordsOf<NumericalError>([&] { remote.doStep(kSimStart, kStepLength, {}); });
}

TEST(RemoteParticipant, BelievesNoReplyThatCannotBe) {
  using Reply = ballbot_msgs::step_reply;
  constexpr std::int64_t kHour = 3'600'000'000'000;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.time_ns += 1; }),
              HasSubstr("plant answered request 2 with what cannot be: it stands at 1000001 ns and "
                        "was asked for 1000000 ns"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.sim_time_ns += kHour; }),
              HasSubstr("sensors.time is 3600.001000 s, at 0.001000 s"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.imu_time_ns += kHour; }),
              HasSubstr("imu_time is 3600.001000 s, at 0.001000 s"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.pose_time_ns = kHour; }),
              HasSubstr("pose_time is 3600.000000 s, at 0.001000 s"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.imu_count = -1; }),
              HasSubstr("imu_count is -1, must be 0 to 1000000000000"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.gyro_WB_B[1] = std::nan(""); }),
              HasSubstr("gyro_WB_B_y is nan"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.joint_torque[4] = -kInf; }),
              HasSubstr("joint_torque_arm2 is -inf"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.sensors.motor_angle[1] = 1e308; }),
              HasSubstr("motor_angle_wheel2 is 1e+308 rad, beyond 1e+06"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.truth[0].q[3] = std::nan(""); }),
              HasSubstr("truth.base_angles_pitch is nan"));
  EXPECT_THAT(wordsOfStep([](Reply& r) { r.truth[0].contact_phase = 17; }),
              HasSubstr("truth.contact_phase is 17, must be 0 to 2"));
}

TEST(RemoteParticipant, CollectsNoStateWithoutEnd) {
  using Reply = ballbot_msgs::step_reply;
  const auto wordsOfSave = [](ChangingTransport::Change change) {
    ChangingTransport transport(std::move(change));
    RemoteParticipant remote(transport, remoteOptions());
    remote.enterInitializationMode(kSimStart);
    return wordsOf<LostParticipantError>([&] { (void)remote.saveState(); });
  };
  const auto expected = HasSubstr("no part of its state that continues");
  EXPECT_THAT(wordsOfSave([](Reply& r) { r.blob_size = std::numeric_limits<int>::max(); }),
              expected);
  EXPECT_THAT(wordsOfSave([](Reply& r) { r.blob_size = -1; }), expected);
  EXPECT_THAT(wordsOfSave([](Reply& r) { r.blob_offset = 5; }), expected);
  EXPECT_THAT(wordsOfSave([](Reply& r) {
                r.chunk_size = 0;
                r.chunk.clear();
              }),
              expected);
}

TEST(RemoteParticipant, PassesNoEscapeSequenceOnToTheTerminal) {
  ChangingTransport transport([](ballbot_msgs::step_reply& r) {
    r.status = ballbot_msgs::step_reply::FAILED;
    r.text = "gone\x1B]0;mine\x07";
  });
  RemoteParticipant remote(transport, remoteOptions());
  remote.enterInitializationMode(kSimStart);
  EXPECT_EQ(wordsOf<LostParticipantError>([&] { remote.doStep(kSimStart, kStepLength, {}); }),
            "gone?]0;mine?");
}

}  // namespace
}  // namespace ballbot
