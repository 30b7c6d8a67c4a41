#include "cosim/lifecycle.hpp"

#include <functional>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::SpringParticipant;
using testing_support::wordsOf;
using S = LifecycleState;

constexpr SimDuration kStepLength{1'000'000};

/// A participant brought into a given state.
struct Brought {
  explicit Brought(S state) {
    if (state == S::kInstantiated) return;
    life.enterInitializationMode(kSimStart);
    if (state == S::kInitialization) return;
    life.exitInitializationMode();
    if (state == S::kTerminated) life.terminate();
    if (state == S::kFailed) {
      spring.failAt(kSimStart + kStepLength);
      EXPECT_THROW(life.doStep(kSimStart, kStepLength, {}), NumericalError);
      spring.failAt(SimTime::max());
    }
  }
  SpringParticipant spring;
  Lifecycle life{spring};
};

StateBlob savedInStepMode() { return Brought(S::kStep).life.saveState(); }

TEST(Lifecycle, AllowsExactlyTheCallsOfFmi3) {
  const StateBlob saved = savedInStepMode();
  struct Row {
    const char* call;
    std::function<void(Lifecycle&)> make;
    std::map<S, S> allowed;  // state before, state after
  };
  const Row rows[] = {
      {"enterInitializationMode",
       [](Lifecycle& l) { l.enterInitializationMode(kSimStart); },
       {{S::kInstantiated, S::kInitialization}}},
      {"exitInitializationMode",
       [](Lifecycle& l) { l.exitInitializationMode(); },
       {{S::kInitialization, S::kStep}}},
      {"doStep",
       [](Lifecycle& l) { l.doStep(kSimStart, kStepLength, {}); },
       {{S::kStep, S::kStep}}},
      {"terminate", [](Lifecycle& l) { l.terminate(); }, {{S::kStep, S::kTerminated}}},
      {"reset",
       [](Lifecycle& l) { l.reset(); },
       {{S::kInstantiated, S::kInstantiated},
        {S::kInitialization, S::kInstantiated},
        {S::kStep, S::kInstantiated},
        {S::kTerminated, S::kInstantiated},
        {S::kFailed, S::kInstantiated}}},
      {"reading",
       [](Lifecycle& l) { (void)l.sensors(); },
       {{S::kStep, S::kStep}, {S::kTerminated, S::kTerminated}}},
      {"reading",
       [](Lifecycle& l) { (void)l.truth(); },
       {{S::kStep, S::kStep}, {S::kTerminated, S::kTerminated}}},
      {"saveState",
       [](Lifecycle& l) { (void)l.saveState(); },
       {{S::kInitialization, S::kInitialization},
        {S::kStep, S::kStep},
        {S::kTerminated, S::kTerminated}}},
      {"restoreState",
       [&](Lifecycle& l) { l.restoreState(saved); },
       {{S::kInitialization, S::kStep},
        {S::kStep, S::kStep},
        {S::kTerminated, S::kStep},
        {S::kFailed, S::kStep}}},
  };
  for (const Row& row : rows) {
    for (const S before :
         {S::kInstantiated, S::kInitialization, S::kStep, S::kTerminated, S::kFailed}) {
      SCOPED_TRACE(std::string(row.call) + " in " + toText(before));
      Brought brought(before);
      const auto after = row.allowed.find(before);
      if (after != row.allowed.end()) {
        row.make(brought.life);
        EXPECT_EQ(brought.life.state(), after->second);
        continue;
      }
      try {
        row.make(brought.life);
        ADD_FAILURE() << "was allowed";
      } catch (const CallOrderError& error) {
        EXPECT_EQ(error.state(), toText(before));
        EXPECT_THAT(error.call(), HasSubstr(row.call));
        EXPECT_THAT(error.what(),
                    HasSubstr(std::string("is not allowed in state '") + toText(before) + "'"));
        EXPECT_EQ(brought.life.state(), before);
      }
    }
  }
}

TEST(Lifecycle, SaysWhatToCallInstead) {
  Brought brought(S::kInstantiated);
  EXPECT_EQ(wordsOf<CallOrderError>([&] { brought.life.doStep(kSimStart, kStepLength, {}); }),
            "spring: doStep is not allowed in state 'instantiated'; call enterInitializationMode "
            "first");
}

TEST(Lifecycle, StepsFollowOneAnotherWithoutGap) {
  Brought brought(S::kStep);
  brought.life.doStep(kSimStart, kStepLength, {});
  EXPECT_EQ(brought.life.time(), kSimStart + kStepLength);
  EXPECT_EQ(wordsOf<CallOrderError>([&] { brought.life.doStep(kSimStart, kStepLength, {}); }),
            "spring: doStep from 0.000000 s, but it stands at 0.001000 s");
  EXPECT_THAT(wordsOf<CallOrderError>(
                  [&] { brought.life.doStep(kSimStart + kStepLength, SimDuration{0}, {}); }),
              HasSubstr("doStep by 0 s, must be above 0"));
  EXPECT_EQ(brought.spring.stepsDone(), 1);
}

TEST(Lifecycle, ACommandThatIsNotFiniteNeverReachesTheParticipant) {
  Brought brought(S::kStep);
  ActuatorCommand command;
  command.torque[4] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(wordsOf<NumericalError>([&] { brought.life.doStep(kSimStart, kStepLength, command); }),
            "spring: command at 0.000000 s: torque_arm2 is inf");
  EXPECT_EQ(brought.spring.stepsDone(), 0);
  EXPECT_EQ(brought.life.state(), S::kStep);
}

TEST(Lifecycle, ASensorValueThatIsNotFiniteIsAFailureOfTheParticipant) {
  Brought brought(S::kStep);
  brought.spring.measureNanFrom(kSimStart + kStepLength);
  EXPECT_EQ(wordsOf<LostParticipantError>([&] { brought.life.doStep(kSimStart, kStepLength, {}); }),
            "spring: after the step to 0.001000 s: sensors.gyro_WB_B_y is nan");
  EXPECT_EQ(brought.life.state(), S::kFailed);
}

TEST(Lifecycle, ARestoredParticipantContinuesBitForBit) {
  Brought one(S::kStep);
  ActuatorCommand command;
  command.torque[1] = 0.3;
  const auto advance = [&](Lifecycle& life, int steps) {
    for (int i = 0; i < steps; ++i) life.doStep(life.time(), kStepLength, command);
  };
  advance(one.life, 10);
  const StateBlob saved = one.life.saveState();
  advance(one.life, 10);

  Brought other(S::kInitialization);
  other.life.restoreState(saved);
  EXPECT_EQ(other.life.time(), kSimStart + 10 * kStepLength);
  advance(other.life, 10);
  EXPECT_EQ(other.life.stateDigest(), one.life.stateDigest());
  EXPECT_EQ(other.life.sensors().joint_angle, one.life.sensors().joint_angle);
}

TEST(Lifecycle, ADamagedStateIsRefusedAndChangesNothing) {
  Brought brought(S::kStep);
  brought.life.doStep(kSimStart, kStepLength, {});
  const std::uint64_t before = brought.life.stateDigest();
  StateBlob damaged = savedInStepMode();
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_THAT(wordsOf<InputError>([&] { brought.life.restoreState(damaged); }),
              HasSubstr("checksum does not match"));
  EXPECT_EQ(brought.life.state(), S::kStep);
  EXPECT_EQ(brought.life.time(), kSimStart + kStepLength);
  EXPECT_EQ(brought.life.stateDigest(), before);
}

}  // namespace
}  // namespace ballbot
