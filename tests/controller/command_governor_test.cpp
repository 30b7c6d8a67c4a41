#include "controller/command_governor.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/state_visitors.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

SimTime at(double seconds) { return kSimStart + durationFromSeconds(seconds); }

class CommandGovernorTest : public ::testing::Test {
 protected:
  CommandGovernorTest() : robot_(exampleRobot()), schedule_(robot_), governor_(robot_, limits_) {
    schedule_.ball_position_weight = TimedWeight<2>(Eigen::Vector2d::Constant(100));
  }

  static ReducedDynamics::EndEffector tip(const Vector3& p_WE,
                                          const Matrix3& R_WE = Matrix3::Identity()) {
    return {p_WE, R_WE, Vector3::Zero(), Vector3::Zero()};
  }
  /// The governor every 14 ms up to `until`, for a robot that is where it was asked to be.
  void followUntil(double until) {
    for (; t_ < until; t_ += 0.014) {
      governor_.update(at(t_), schedule_, x_, tip(schedule_.ee_position.value(t_)));
      x_.segment<2>(kBallX) = governor_.commands().ball_position.anchor;
    }
  }
  Eigen::Vector2d reference(double ahead) const {
    return governor_.commands().ball_position.reference(schedule_.ball_position.value(t_), ahead);
  }

  RobotParameters robot_;
  TaskSchedule schedule_;
  CommandLimits limits_;
  CommandGovernor governor_;
  StateVector x_ = StateVector::Zero();
  double t_ = 0;
};

TEST_F(CommandGovernorTest, TakesAStepWithinReachAsItIs) {
  schedule_.ball_position.step(0.1, {0.3, -0.3999});
  followUntil(0.12);
  EXPECT_EQ(reference(0), Eigen::Vector2d(0.3, -0.3999));
  EXPECT_EQ(reference(1), Eigen::Vector2d(0.3, -0.3999));
  EXPECT_FALSE(governor_.cutting());
}

TEST_F(CommandGovernorTest, ApproachesAFarStepAtItsSpeedAndArrivesExactly) {
  const Eigen::Vector2d goal(3, 4);
  schedule_.ball_position.step(0.1, goal);
  followUntil(0.12);
  EXPECT_TRUE(governor_.cutting());
  EXPECT_LE(reference(0).norm(), limits_.lead + limits_.speed * 0.03);
  EXPECT_NEAR((reference(1) - reference(0)).norm(), limits_.speed, 1e-12);
  EXPECT_NEAR(reference(1).normalized().dot(goal.normalized()), 1, 1e-12);  // straight ahead

  double last = reference(0).norm();
  for (double t = 0.2; t < 8; t += 0.014) {
    followUntil(t);
    const double now = reference(0).norm();
    EXPECT_LE(now - last, limits_.speed * 0.028 + 1e-9) << t;  // no jump on the way or at the end
    last = now;
  }
  followUntil(9);
  EXPECT_EQ(reference(0), goal);
  EXPECT_FALSE(governor_.cutting());
}

TEST_F(CommandGovernorTest, StaysNearARobotThatIsHeldBack) {
  schedule_.ball_position.step(0.1, {5, 0});
  for (; t_ < 4; t_ += 0.014) governor_.update(at(t_), schedule_, x_, tip(Vector3::Zero()));
  EXPECT_LE(reference(0).norm(), limits_.lag + limits_.lead);
}

TEST_F(CommandGovernorTest, RatesOfPlannedMotionsAreCutToTheSpeed) {
  schedule_.ball_position.ramp(0, 2, {6, 0});
  Tasks tasks;
  followUntil(0.5);
  schedule_.at(t_ + 0.2, t_, tasks, {}, governor_.commands());
  EXPECT_NEAR(tasks.ball_velocity.x(), limits_.speed, 1e-12);
  EXPECT_LT(tasks.ball_position.x(), 1);
}

TEST_F(CommandGovernorTest, HeightsBeyondTheArmAndAnglesBeyondStopsAreAskedForAtTheBoundary) {
  schedule_.arm_position.step(0, {0, 9, -9});
  schedule_.ee_position.step(0, {0, 0, 50});
  followUntil(0.01);
  const GovernedCommands& commands = governor_.commands();
  EXPECT_LT(commands.ee_position.upper.z(), 1.4);
  EXPECT_GT(commands.ee_position.upper.z(), 1.2);
  EXPECT_LE(commands.ee_position.reference({0, 0, 50}, 100).z(), commands.ee_position.upper.z());
  const Vector3 arm = commands.arm_position.reference({0, 9, -9}, 100);
  EXPECT_LE(arm[1], robot_.arm[1].upper_limit);
  EXPECT_GE(arm[2], robot_.arm[2].lower_limit);
}

TEST_F(CommandGovernorTest, AnOrientationTurnsTheShortWayAtItsSpeedAndArrivesExactly) {
  const Vector3 asked(2 * M_PI - 1.5, 0.2, -0.3);  // nearer the other way round
  const Matrix3 goal = rotationFromYawPitchRoll(asked[0], asked[1], asked[2]);
  Matrix3 R = rotationFromYawPitchRoll(0, 0, 0), last = R;
  schedule_.ee_orientation = TimeSignal<3>(Vector3::Zero());
  schedule_.ee_orientation.step(0.1, asked);
  const GovernedOrientation& turn = governor_.commands().ee_orientation;
  for (; t_ < 4; t_ += 0.014) {
    governor_.update(at(t_), schedule_, x_, tip(Vector3::Zero(), R));
    const Vector3 now = schedule_.ee_orientation.value(t_);
    const Matrix3 reference = turn.reference(rotationFromYawPitchRoll(now[0], now[1], now[2]), 0);
    EXPECT_LE(logSO3(reference * last.transpose()).norm(),
              limits_.angle_lead + limits_.angle_speed * 0.015)
        << t_;
    if (t_ > 0.12 && t_ < 1) EXPECT_LT(yawPitchRollFromRotation(reference)[0], 0);
    last = reference;
    R = turn.anchor;
  }
  EXPECT_EQ(last, goal);
  EXPECT_FALSE(turn.approaching);
}

TEST_F(CommandGovernorTest, AnOrientationStaysNearTheRobots) {
  schedule_.ee_orientation = TimeSignal<3>(Vector3::Zero());
  schedule_.ee_orientation.step(0.1, {0, 0, 2.5});
  for (; t_ < 6; t_ += 0.014) governor_.update(at(t_), schedule_, x_, tip(Vector3::Zero()));
  const Matrix3 reference =
      governor_.commands().ee_orientation.reference(rotationFromYawPitchRoll(0, 0, 2.5), 0);
  EXPECT_NEAR(logSO3(reference).norm(), limits_.angle_lag + limits_.angle_lead, 1e-9);
}

TEST_F(CommandGovernorTest, ContinuesAfterASaveAsIfNothingWas) {
  schedule_.ball_position.step(0.1, {3, 4});
  followUntil(1);
  CommandGovernor other(robot_, limits_);
  restoreStateOf(other, saveStateOf(governor_, "test", 1), "test", 1);
  governor_.update(at(1.1), schedule_, x_, tip(Vector3::Zero()));
  other.update(at(1.1), schedule_, x_, tip(Vector3::Zero()));
  EXPECT_EQ(governor_.commands().ball_position.anchor, other.commands().ball_position.anchor);
  EXPECT_EQ(governor_.commands().ball_position.approaching,
            other.commands().ball_position.approaching);
  EXPECT_EQ(governor_.cutting(), other.cutting());
}

}  // namespace
}  // namespace ballbot
