#include "hil/safety.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

using Action = SafetyAction;
using State = SafetyState;

Safety::Events calm() {
  Safety::Events e;
  e.prepare = e.at_rest = e.drives_switched_on = true;
  return e;
}

/// A bench that follows commands since `cycles` cycles.
Safety following(int cycles = 1) {
  Safety s({4, 3});
  Safety::Events e = calm();
  s.step(e);
  e.engage = true;
  s.step(e);
  e.drives_enabled = true;
  for (int i = 0; i < cycles; ++i) s.step(e);
  EXPECT_EQ(s.action(), Action::kFollow);
  return s;
}

constexpr BenchFault kLast = BenchFault::kBusDown;

TEST(Safety, GoesFromDisabledOverReadyToEnabled) {
  Safety s({4, 3});
  EXPECT_EQ(s.step({}), Action::kNoVoltage);
  Safety::Events e = calm();
  e.drives_switched_on = false;
  EXPECT_EQ(s.step(e), Action::kSwitchedOn);
  EXPECT_EQ(s.state(), State::kDisabled) << "not before all drives have confirmed";
  e.drives_switched_on = true;
  s.step(e);
  EXPECT_EQ(s.state(), State::kReady);
  e.engage = true;
  EXPECT_EQ(s.step(e), Action::kZeroTorque);
  EXPECT_EQ(s.step(e), Action::kZeroTorque) << "torque only once all drives are enabled";
  e.drives_enabled = true;
  EXPECT_EQ(s.step(e), Action::kFollow);
  EXPECT_EQ(s.followed(), 0);
  s.step(e);
  EXPECT_EQ(s.followed(), 1);
}

// A stop brakes with little torque, so the arm may well sink into a limit on the way.
TEST(Safety, AStopEndsDisabledWhateverMilderFaultIsMetOnTheWay) {
  for (int n = 1; n <= static_cast<int>(kLast); ++n) {
    const auto fault = static_cast<BenchFault>(n);
    Safety s = following();
    Safety::Events e = calm();
    e.engage = e.drives_enabled = e.stop = true;
    EXPECT_EQ(s.step(e), Action::kDamp);
    e.fault = fault;
    EXPECT_EQ(s.step(e), dampsFirst(fault) ? Action::kDamp : Action::kNoVoltage) << toText(fault);
    for (int i = 0; i < 3; ++i) s.step(e);
    EXPECT_EQ(s.action(), Action::kNoVoltage) << toText(fault);
    EXPECT_EQ(s.state(), dampsFirst(fault) ? State::kDisabled : State::kFault) << toText(fault);
  }
}

TEST(Safety, EngagesOnlyAtRest) {
  Safety s({4, 3});
  Safety::Events e = calm();
  s.step(e);
  e.engage = true;
  e.at_rest = false;
  EXPECT_EQ(s.step(e), Action::kSwitchedOn);
  EXPECT_TRUE(s.engageRefused());
  e.at_rest = true;
  EXPECT_EQ(s.step(e), Action::kZeroTorque);
}

TEST(Safety, EveryFaultLatchesAndEndsWithoutVoltage) {
  for (int f = 1; f <= static_cast<int>(kLast); ++f) {
    const auto fault = static_cast<BenchFault>(f);
    Safety s = following();
    Safety::Events e = calm();
    e.engage = e.drives_enabled = true;
    e.fault = fault;
    const Action first = s.step(e);
    EXPECT_EQ(first, dampsFirst(fault) ? Action::kDamp : Action::kNoVoltage) << toText(fault);
    e.fault = BenchFault::kNone;
    int damped = first == Action::kDamp ? 1 : 0;
    while (s.step(e) == Action::kDamp) ++damped;
    EXPECT_EQ(damped, dampsFirst(fault) ? 4 : 0);
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(s.step(e), Action::kNoVoltage) << "no automatic restart";
      ASSERT_EQ(s.state(), State::kFault);
    }
    EXPECT_EQ(s.fault(), fault);
  }
}

TEST(Safety, AGraverFaultEndsTheDampingOfAMilderOne) {
  Safety s = following();
  Safety::Events e = calm();
  e.fault = BenchFault::kTiltLimit;
  EXPECT_EQ(s.step(e), Action::kDamp);
  e.fault = BenchFault::kDriveFault;
  EXPECT_EQ(s.step(e), Action::kNoVoltage);
  EXPECT_EQ(s.fault(), BenchFault::kTiltLimit) << "the first one is the reason";
}

TEST(Safety, AFaultThatLastsDoesNotProlongTheDamping) {
  Safety s = following();
  Safety::Events e = calm();
  e.fault = BenchFault::kCommandTimeout;
  int damped = 0;
  while (s.step(e) == Action::kDamp) ++damped;
  EXPECT_EQ(damped, 4);
}

TEST(Safety, AStopDampsAndDisablesAndMayStartAgain) {
  Safety s = following();
  Safety::Events e = calm();
  e.drives_enabled = e.stop = true;
  int damped = 0;
  while (s.step(e) == Action::kDamp) ++damped;
  EXPECT_EQ(damped, 4);
  EXPECT_EQ(s.state(), State::kDisabled);
  EXPECT_EQ(s.step(e), Action::kNoVoltage);
  e.stop = e.drives_enabled = false;
  s.step(e);
  EXPECT_EQ(s.state(), State::kReady);
}

TEST(Safety, DrivesThatDoNotFollowAreAFault) {
  Safety s({4, 3});
  Safety::Events e = calm();
  e.drives_switched_on = false;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(s.step(e), Action::kSwitchedOn);
  EXPECT_EQ(s.step(e), Action::kNoVoltage);
  EXPECT_EQ(s.fault(), BenchFault::kDriveTransition);
}

// All states against all events: torque in the first cycle only where everything allows it.
TEST(Safety, FollowsOnlyWhenEngagedEnabledAndWithoutFault) {
  for (unsigned bits = 0; bits < 1U << 6; ++bits) {
    for (int f = 0; f <= static_cast<int>(kLast); ++f) {
      Safety::Events e;
      e.prepare = bits & 1;
      e.engage = bits & 2;
      e.stop = bits & 4;
      e.at_rest = bits & 8;
      e.drives_switched_on = bits & 16;
      e.drives_enabled = bits & 32;
      e.fault = static_cast<BenchFault>(f);
      Safety fresh({4, 3});
      for (int i = 0; i < 20; ++i) {
        if (fresh.step(e) != Action::kFollow) continue;
        ASSERT_TRUE(e.prepare && e.engage && !e.stop && e.at_rest && e.drives_switched_on &&
                    e.drives_enabled && f == 0);
      }
    }
  }
}

}  // namespace
}  // namespace ballbot
