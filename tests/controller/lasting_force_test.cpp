#include "controller/lasting_force.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/state_visitors.hpp"

namespace ballbot {
namespace {

OffsetFree enabled() {
  OffsetFree settings;
  settings.enabled = true;
  return settings;
}

/// Frames of 2.5 ms with what the model does not explain.
class Felt {
 public:
  explicit Felt(const OffsetFree& settings = enabled()) : lasting(settings) {}
  void run(double seconds, const VelocityVector& residual, bool explained = false) {
    for (int n = 0; n < std::lround(seconds / 0.0025); ++n) {
      now_ += SimDuration(2'500'000);
      lasting.update(now_, residual, explained);
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
  d[kArmRate2] = arm;
  return d;
}

TEST(LastingForce, WhatStaysIsLearnedAfterHalfASecondByAFirstOrderLag) {
  const VelocityVector d = force(8, -3, 5);
  Felt robot;
  robot.run(0.49, d);
  EXPECT_EQ(robot.lasting.force(), VelocityVector::Zero());
  robot.run(0.01, d);
  robot.run(2, d);
  EXPECT_TRUE(robot.lasting.learning());
  EXPECT_LT((robot.lasting.force() - (1 - std::exp(-2.0)) * d).norm(), 0.01 * d.norm());
}

TEST(LastingForce, APushOfHalfASecondLeavesNothing) {
  Felt robot;
  robot.run(2, VelocityVector::Zero());
  robot.run(0.5, force(20, 7, 0));
  EXPECT_LT(robot.lasting.force().norm(), 0.1);
  robot.run(2, VelocityVector::Zero());
  EXPECT_LT(robot.lasting.force().norm(), 0.1);
}

TEST(LastingForce, WhatIsExplainedOtherwiseIsNotLearned) {
  Felt robot;
  robot.run(5, force(8, 0, 0), true);
  EXPECT_EQ(robot.lasting.force(), VelocityVector::Zero());
  robot.run(0.4, force(8, 0, 0));
  EXPECT_EQ(robot.lasting.force(), VelocityVector::Zero()) << "it is over, but not for long enough";
  robot.run(5, force(8, 0, 0));
  EXPECT_GT(robot.lasting.force()[kBallVx], 7.5);
  robot.run(5, VelocityVector::Zero(), true);
  EXPECT_GT(robot.lasting.force()[kBallVx], 7.5) << "kept";
}

TEST(LastingForce, IsBoundedRowByRow) {
  OffsetFree settings = enabled();
  settings.force_limit_N = 5;
  settings.moment_limit_Nm = 2;
  settings.arm_limit_Nm = 1;
  Felt robot(settings);
  robot.run(20, force(50, -50, 50));
  EXPECT_EQ(robot.lasting.force(), force(5, -2, 1));
}

TEST(LastingForce, DoesNothingUnlessAsked) {
  Felt robot{OffsetFree()};
  robot.run(5, force(8, 3, 2));
  EXPECT_EQ(robot.lasting.force(), VelocityVector::Zero());
}

TEST(LastingForce, PassesOverWhatIsNoNumber) {
  Felt robot;
  robot.run(3, force(8, 0, 0));
  const VelocityVector before = robot.lasting.force();
  robot.run(0.5, VelocityVector::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(robot.lasting.force(), before);
  robot.run(2, force(8, 0, 0));
  EXPECT_GT(robot.lasting.force()[kBallVx], before[kBallVx]);
}

TEST(LastingForce, GoesOnFromASavedState) {
  Felt robot, other;
  robot.run(1.3, force(8, 1, 0));
  restoreStateOf(other.lasting, saveStateOf(robot.lasting, "lasting", 1), "lasting", 1);
  EXPECT_EQ(other.lasting.force(), robot.lasting.force());
  EXPECT_EQ(other.lasting.learning(), robot.lasting.learning());
}

}  // namespace
}  // namespace ballbot
