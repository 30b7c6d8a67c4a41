#include "controller/lasting_force.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/state_visitors.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

/// Frames of 2.5 ms with what the model does not explain.
class Felt {
 public:
  explicit Felt(const OffsetFree& settings = OffsetFree{}) : lasting(exampleRobot(), settings) {}
  void run(double seconds, const VelocityVector& residual, bool explained = false) {
    for (int n = 0; n < std::lround(seconds / 0.0025); ++n) {
      now_ += SimDuration(2'500'000);
      lasting.update(now_, {residual, Vector3::Zero(), explained});
    }
  }
  LastingForce lasting;

 private:
  SimTime now_ = kSimStart;
};

VelocityVector force(double along, double moment, double arm) {
  VelocityVector d = VelocityVector::Zero();
  d[kBallVx] = along;
  d[kOmegaY] = moment;
  d[kArmRate1 + 1] = arm;
  return d;
}

TEST(LastingForce, WhatStaysIsLearnedAfterHalfASecondByAFirstOrderLag) {
  const VelocityVector d = force(8, -3, 5);
  Felt robot;
  robot.run(0.49, d);
  EXPECT_EQ(robot.lasting.forces().rest, VelocityVector::Zero());
  robot.run(0.01, d);
  robot.run(2, d);
  EXPECT_TRUE(robot.lasting.learning());
  EXPECT_LT((robot.lasting.forces().rest - (1 - std::exp(-2.0)) * d).norm(), 0.01 * d.norm());
}

TEST(LastingForce, APushOfHalfASecondLeavesNothing) {
  Felt robot;
  robot.run(2, VelocityVector::Zero());
  robot.run(0.5, force(20, 7, 0));
  EXPECT_LT(robot.lasting.forces().rest.norm(), 0.1);
  robot.run(2, VelocityVector::Zero());
  EXPECT_LT(robot.lasting.forces().rest.norm(), 0.1);
}

TEST(LastingForce, WhatIsExplainedOtherwiseIsNotLearned) {
  Felt robot;
  robot.run(5, force(8, 0, 0), true);
  EXPECT_EQ(robot.lasting.forces().rest, VelocityVector::Zero());
  robot.run(0.4, force(8, 0, 0));
  EXPECT_EQ(robot.lasting.forces().rest, VelocityVector::Zero())
      << "it is over, but not for long enough";
  robot.run(5, force(8, 0, 0));
  EXPECT_GT(robot.lasting.forces().rest[kBallVx], 7.5);
  robot.run(5, VelocityVector::Zero(), true);
  EXPECT_GT(robot.lasting.forces().rest[kBallVx], 7.5) << "kept";
}

TEST(LastingForce, IsBoundedRowByRow) {
  OffsetFree settings;
  settings.force_limit_N = 5;
  settings.moment_limit_Nm = 2;
  settings.arm_limit_Nm = 1;
  Felt robot(settings);
  robot.run(20, force(50, -50, 50));
  EXPECT_EQ(robot.lasting.forces().rest, force(5, -2, 1));
}

TEST(LastingForce, DoesNothingWhereItIsOff) {
  OffsetFree off;
  off.enabled = false;
  Felt robot(off);
  robot.run(5, force(8, 3, 2));
  EXPECT_EQ(robot.lasting.forces().rest, VelocityVector::Zero());
}

TEST(LastingForce, PassesOverWhatIsNoNumber) {
  Felt robot;
  robot.run(3, force(8, 0, 0));
  const VelocityVector before = robot.lasting.forces().rest;
  robot.run(0.5, VelocityVector::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(robot.lasting.forces().rest, before);
  robot.run(2, force(8, 0, 0));
  EXPECT_GT(robot.lasting.forces().rest[kBallVx], before[kBallVx]);
}

/// A mass in the hand as the observer shows it: what is not counted on yet.
void hang(LastingForce& lasting, SimTime& now, double seconds, double mass, double sideways = 0) {
  for (int n = 0; n < std::lround(seconds / 0.0025); ++n) {
    now += SimDuration(2'500'000);
    const double felt = -9.81 * (mass - lasting.forces().hand_mass);
    lasting.update(now, {VelocityVector::Zero(), Vector3(sideways, 0, felt), false});
  }
}

TEST(LastingForce, AMassInTheHandIsLearnedBeforeTheRest) {
  LastingForce lasting(exampleRobot(), OffsetFree{});
  SimTime now = kSimStart;
  hang(lasting, now, 0.4, 2);
  EXPECT_EQ(lasting.forces().hand_mass, 0);
  EXPECT_FALSE(lasting.handKnown());
  hang(lasting, now, 0.8, 2);
  EXPECT_GT(lasting.forces().hand_mass, 1);
  EXPECT_FALSE(lasting.learning()) << "the rest waits";
  hang(lasting, now, 4, 2);
  EXPECT_NEAR(lasting.forces().hand_mass, 2, 0.01);
  EXPECT_TRUE(lasting.handKnown());
  EXPECT_TRUE(lasting.learning());
}

TEST(LastingForce, WhatIsTouchedIsNoMassInTheHand) {
  LastingForce lasting(exampleRobot(), OffsetFree{});
  SimTime now = kSimStart;
  hang(lasting, now, 5, 0.2, 4);
  EXPECT_LT(lasting.forces().hand_mass, 0.01);
  EXPECT_FALSE(lasting.learning());
}

TEST(LastingForce, AHandThatIsEmptierThanToldHoldsNoLessThanNothing) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 0.5;
  LastingForce lasting(robot, OffsetFree{});
  SimTime now = kSimStart;
  hang(lasting, now, 8, -0.5);
  EXPECT_NEAR(lasting.handMass(), 0, 0.01);
  hang(lasting, now, 8, -2);
  EXPECT_EQ(lasting.handMass(), 0);
}

TEST(LastingForce, GoesOnFromASavedState) {
  Felt robot, other;
  robot.run(1.3, force(8, 1, 0));
  restoreStateOf(other.lasting, saveStateOf(robot.lasting, "lasting", 1), "lasting", 1);
  EXPECT_EQ(other.lasting.forces().rest, robot.lasting.forces().rest);
  EXPECT_EQ(other.lasting.learning(), robot.lasting.learning());
}

}  // namespace
}  // namespace ballbot
