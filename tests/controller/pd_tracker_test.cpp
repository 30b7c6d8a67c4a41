#include "controller/pd_tracker.hpp"

#include <cstdlib>
#include <limits>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

class PdTrackerTest : public testing::Test {
 protected:
  PdTrackerTest() {
    config_.stiffness << 0.2, 0.2, 0.2, 8, 8, 8;
    config_.damping << 0.02, 0.02, 0.02, 0.6, 0.6, 0.6;
    config_.torque_limit << 4, 4, 4, 18, 18, 18;
    policy_.torque << 0.1, -0.2, 0.3, 1, -2, 3;
    policy_.feedback.setRandom();
    policy_.feedback *= 0.1;
    policy_.x.setConstant(0.5);
    policy_.joint_position.setConstant(0.2);
    policy_.joint_velocity.setConstant(-0.4);
  }
  RobotParameters robot_ = exampleRobot();
  TrackerConfig config_;
  PolicySample policy_;
  StateVector x_ = StateVector::LinSpaced(0, 1);
  JointVector angle_ = JointVector::LinSpaced(-1, 1), velocity_ = JointVector::LinSpaced(1, -1);
  ActuatorCommand command_;
};

TEST_F(PdTrackerTest, AddsFeedforwardStateFeedbackAndJointPd) {
  ASSERT_EQ(PdTracker(config_).step(policy_, x_, angle_, velocity_, command_), TrackStatus::kOk);
  for (int i = 0; i < kJointCount; ++i) {
    const double expected = policy_.torque[i] + policy_.feedback.row(i).dot(x_ - policy_.x) +
                            config_.stiffness[i] * (0.2 - angle_[i]) +
                            config_.damping[i] * (-0.4 - velocity_[i]);
    EXPECT_NEAR(command_.torque[i], expected, 1e-14);
  }
  EXPECT_EQ(command_.stiffness, JointVector::Zero());
}

TEST_F(PdTrackerTest, WithTheLoopInTheDrivesBothWaysGiveTheSameTorque) {
  ActuatorCommand to_drives;
  ASSERT_EQ(PdTracker(config_).step(policy_, x_, angle_, velocity_, command_), TrackStatus::kOk);
  config_.pd_loop = TrackerConfig::PdLoop::kDrives;
  ASSERT_EQ(PdTracker(config_).step(policy_, x_, angle_, velocity_, to_drives), TrackStatus::kOk);
  const JointVector applied =  // what ActuatorCommand says a drive does
      to_drives.torque + to_drives.stiffness.cwiseProduct(to_drives.position - angle_) +
      to_drives.damping.cwiseProduct(to_drives.velocity - velocity_);
  EXPECT_LT((applied - command_.torque).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_F(PdTrackerTest, TakesOnlyTheShareOfFeedbackItIsTold) {
  config_.policy_feedback = 0;
  config_.stiffness.setZero();
  config_.damping.setZero();
  ASSERT_EQ(PdTracker(config_).step(policy_, x_, angle_, velocity_, command_), TrackStatus::kOk);
  EXPECT_EQ(command_.torque, policy_.torque);
}

TEST_F(PdTrackerTest, CutsAtTheTorqueLimitAndSaysSo) {
  policy_.torque[1] = 100;
  policy_.torque[5] = -100;
  EXPECT_EQ(PdTracker(config_).step(policy_, x_, angle_, velocity_, command_),
            TrackStatus::kTorqueSaturated);
  EXPECT_EQ(command_.torque[1], 4);
  EXPECT_EQ(command_.torque[5], -18);
}

TEST_F(PdTrackerTest, KeepsTheLastGoodCommandWhenAnythingIsNotFinite) {
  const PdTracker tracker(config_);
  ASSERT_EQ(tracker.step(policy_, x_, angle_, velocity_, command_), TrackStatus::kOk);
  const JointVector good = command_.torque;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  x_[3] = nan;
  EXPECT_EQ(tracker.step(policy_, x_, angle_, velocity_, command_), TrackStatus::kNotFinite);
  x_[3] = 0;
  velocity_[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(tracker.step(policy_, x_, angle_, velocity_, command_), TrackStatus::kNotFinite);
  velocity_[0] = 0;
  policy_.torque[2] = nan;
  EXPECT_EQ(tracker.step(policy_, x_, angle_, velocity_, command_), TrackStatus::kNotFinite);
  EXPECT_EQ(command_.torque, good);
}

TEST_F(PdTrackerTest, DoesNotAllocate) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  const PdTracker tracker(config_);
  const auto before = allocationCount();
  for (int i = 0; i < 100; ++i) {
    if (tracker.step(policy_, x_, angle_, velocity_, command_) != TrackStatus::kOk) break;
  }
  EXPECT_EQ(allocationCount(), before);
  void* volatile something = std::malloc(8);
  std::free(something);
  EXPECT_GT(allocationCount(), before) << "the counter counts";
}

TEST_F(PdTrackerTest, ItsLimitsMayNotExceedTheRobots) {
  const ConfigNode tree = parseYaml("{wheel_torque_limit_Nm: 40}", "tracker.yaml");
  ConfigReader in(tree);
  try {
    TrackerConfig::read(in, robot_);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("wheel_torque_limit_Nm is 40"));
  }
}

}  // namespace
}  // namespace ballbot
