// A floor whose hold on the ball is learned from how the ball spins. The motion is written down in
// closed form here: momentum of ball and wheels about the vertical, and a floor of known friction.
#include "controller/floor_hold.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/state_visitors.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr double kFrame_s = 0.0025;

/// A robot that stands upright and does not turn while its wheels twist the ball.
class Twisted {
 public:
  explicit Twisted(const FloorBelief& settings)
      : robot_(exampleRobot()), hold_(robot_, settings), spin_torque_(robot_) {}

  /// @param torque  of the wheels on the ball about the vertical, theirs included [N m]
  void run(double seconds, double torque, double floor) {
    const StateVector x = StateVector::Zero();
    const Vector3 c = spin_torque_.at(x).c;
    // The ball drives the wheels: rates are c spin, so that power agrees, and their inertia is part
    // of what turns.
    const double inertia = robot_.ball.inertia + robot_.wheels.spin_inertia * c.squaredNorm();
    constexpr int kSteps = 50;
    for (double t = 0; t < seconds; t += kFrame_s) {
      for (int i = 0; i < kSteps; ++i) {
        spin_ += kFrame_s / kSteps * (torque - floor * std::tanh(spin_ / 0.02)) / inertia;
      }
      now_ += SimDuration(2'500'000);
      JointVector joint_torque = JointVector::Zero(), velocity = JointVector::Zero();
      joint_torque.head<kWheelCount>() = torque / c.squaredNorm() * c;
      velocity.head<kWheelCount>() = spin_ * c;
      hold_.update(now_, x, spin_, joint_torque, velocity);
    }
  }
  double held() const { return hold_.held(); }
  double spin() const { return spin_; }
  FloorHold& hold() { return hold_; }

 private:
  RobotParameters robot_;
  FloorHold hold_;
  SpinTorque spin_torque_;
  SimTime now_ = kSimStart;
  double spin_ = 0;
};

TEST(FloorHold, ABallThatSpinsTellsWhatTheFloorHolds) {
  for (const double floor : {0.2, 0.3, 0.8, 1.5}) {
    Twisted robot{FloorBelief()};
    robot.run(0.5, floor + 0.1, floor);
    ASSERT_GT(robot.spin(), 0.5);
    EXPECT_NEAR(robot.held(), floor, 0.01 * floor);
  }
}

TEST(FloorHold, AlsoWhenItSpinsTheOtherWay) {
  Twisted robot{FloorBelief()};
  robot.run(0.5, -0.3, 0.2);
  ASSERT_LT(robot.spin(), -0.5);
  EXPECT_NEAR(robot.held(), 0.2, 0.002);
}

TEST(FloorHold, WhatItHeldItHolds) {
  FloorBelief settings;
  settings.raised = 0;
  Twisted robot{settings};
  robot.run(0.5, 0.7, 2);
  EXPECT_NEAR(robot.held(), 0.7, 0.01);
}

TEST(FloorHold, MoreIsTriedWhereAllOfItIsUsedUntilTheBallSpins) {
  FloorBelief settings;
  Twisted robot{settings};
  for (int i = 0; i < 200; ++i) robot.run(0.1, 0.7 * robot.held(), 1);
  EXPECT_GT(robot.held(), 1);
  EXPECT_LE(robot.held(), settings.largest);
  Twisted idle{settings};
  idle.run(20, 0.1, 1);
  EXPECT_EQ(idle.held(), settings.spin_torque) << "not where little is used";
}

TEST(FloorHold, WhatIsTriedStopsForAWhileWhereTheBallHasSpun) {
  Twisted robot{FloorBelief()};
  robot.run(0.5, 0.4, 0.3);
  robot.run(0.2, 0, 0.3);
  const double learned = robot.held();
  robot.run(1, 0.7 * learned, 0.3);
  EXPECT_LT(robot.held(), 1.15 * learned);
}

TEST(FloorHold, KeepsWhatItWasToldWhereItShallNotLearn) {
  FloorBelief settings;
  settings.learned = false;
  Twisted fixed{settings};
  fixed.run(1, 0.9, 0.2);
  EXPECT_EQ(fixed.held(), settings.spin_torque);
  settings.limited = false;
  Twisted unlimited{settings};
  unlimited.run(1, 0.9, 0.2);
  EXPECT_EQ(unlimited.held(), kUnlimited);
}

TEST(FloorHold, NeverLeavesItsRange) {
  FloorBelief settings;
  Twisted icy{settings};
  icy.run(1, 0.2, 0.01);
  EXPECT_NEAR(icy.held(), settings.least, 1e-3);
  Twisted glued{settings};
  glued.run(1, 5, 50);
  EXPECT_EQ(glued.held(), settings.largest);
}

TEST(FloorHold, LearnsNothingFromWhatIsNotFiniteOrWasNotSeen) {
  FloorBelief settings;
  FloorHold hold(exampleRobot(), settings);
  const StateVector x = StateVector::Zero();
  JointVector torque = JointVector::Constant(0.2), bad = torque;
  bad[1] = std::nan("");
  const JointVector still = JointVector::Zero();
  SimTime now = kSimStart;
  for (int i = 0; i < 100; ++i) {
    now += SimDuration(2'500'000);
    hold.update(now, x, i % 40 < 20 ? 0.0 : 2.0, i % 10 == 5 ? bad : torque, still);
  }
  EXPECT_EQ(hold.held(), settings.spin_torque);
  for (int i = 0; i < 20; ++i) {  // of a second each nobody knows what was between
    now += SimDuration(1'000'000'000);
    hold.update(now, x, 2.0, torque, still);
  }
  EXPECT_EQ(hold.held(), settings.spin_torque);
}

TEST(FloorHold, GoesOnFromASavedState) {
  Twisted robot{FloorBelief()}, other{FloorBelief()};
  robot.run(0.33, 0.5, 0.3);
  const StateBlob blob = saveStateOf(robot.hold(), "floor", 1);
  restoreStateOf(other.hold(), blob, "floor", 1);
  EXPECT_EQ(other.held(), robot.held());
}

}  // namespace
}  // namespace ballbot
