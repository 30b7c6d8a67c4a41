#include "controller/lqr_law.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "tests/controller/support/closed_loop.hpp"
#include "tests/controller/support/make_law.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

std::string controllerFile() { return BALLBOT_SOURCE_DIR "/configs/controllers/lqr.yaml"; }

class LqrLawTest : public testing::Test {
 protected:
  LqrLawTest() {
    ConfigReader in(tree_);
    ConfigReader lqr = in.child("lqr");
    config_ = LqrLawConfig::read(lqr, robot_);
    ConfigReader tracker = in.child("tracker");
    tracker_ = TrackerConfig::read(tracker, robot_);
  }
  StateVector atRest() const { return LqrLaw(robot_, config_).solution().equilibrium.x; }

  RobotParameters robot_ = exampleRobot();
  ConfigNode tree_ = loadYamlFile(controllerFile());
  LqrLawConfig config_;
  TrackerConfig tracker_;
};

TEST_F(LqrLawTest, BringsTheRobotBackFromThreeDegreesDespiteDrivesAndNoise) {
  LqrLaw law(robot_, config_);
  StateVector x0 = atRest();
  x0[kPitch] += 3 * M_PI / 180;
  x0[kRoll] -= 3 * M_PI / 180;
  const auto run = runClosedLoop(law, tracker_, robot_, x0, 10);
  ASSERT_NEAR(run.back().time, 10, 1e-3) << "fell";
  double largest_tilt = 0, largest_torque = 0;
  for (const auto& s : run) {
    largest_tilt = std::max(largest_tilt, s.tilt);
    if (s.time < 6) continue;
    largest_torque = std::max(largest_torque, s.command.head<3>().cwiseAbs().maxCoeff());
    ASSERT_LT(s.x.head<2>().norm(), 0.03) << "at " << s.time << " s";
  }
  EXPECT_LT(largest_tilt, 10 * M_PI / 180);
  EXPECT_LT(largest_torque, 1.5) << "noise works the wheels";
}

TEST_F(LqrLawTest, SurvivesAPushOf20NForHalfASecond) {
  LqrLaw law(robot_, config_);
  ClosedLoopOptions options;
  options.push = [](double t) { return t >= 2 && t < 2.5 ? Vector3(0, 20, 0) : Vector3(0, 0, 0); };
  const auto run = runClosedLoop(law, tracker_, robot_, atRest(), 12, options);
  ASSERT_NEAR(run.back().time, 12, 1e-3) << "fell";
  double excursion = 0;
  for (const auto& s : run) excursion = std::max(excursion, s.x.head<2>().norm());
  EXPECT_LT(excursion, 0.7);
  EXPECT_LT(run.back().x.head<2>().norm(), 0.05);
}

TEST_F(LqrLawTest, CruisesToAFarSetPointAndTurnsMoreThanOnce) {
  config_.set_point.ball_position << 3, -2;
  config_.set_point.yaw = 7;
  LqrLaw law(robot_, config_);
  const auto run = runClosedLoop(law, tracker_, robot_, atRest(), 25);
  ASSERT_NEAR(run.back().time, 25, 1e-3) << "fell";
  double fastest = 0;
  for (const auto& s : run) fastest = std::max(fastest, s.x.segment<2>(kPositionDim).norm());
  EXPECT_LT(fastest, 1.0);
  EXPECT_LT((run.back().x.head<2>() - config_.set_point.ball_position).norm(), 0.05);
  EXPECT_NEAR(run.back().x[kYaw], 7, 0.03);
}

TEST_F(LqrLawTest, KeepsItsPlanWhenTheEstimateIsNotFinite) {
  LqrLaw law(robot_, config_);
  ASSERT_TRUE(law.plan(kSimStart, atRest(), JointVector::Ones()).accepted);
  law.activatePlan();
  PolicySample before, after;
  law.sample(kSimStart, before);
  StateVector bad = atRest();
  bad[kRoll] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(law.plan(kSimStart, bad, JointVector::Ones()).accepted);
  law.activatePlan();
  law.sample(kSimStart, after);
  EXPECT_EQ(before.x, after.x);
  EXPECT_EQ(before.feedback, after.feedback);
}

TEST_F(LqrLawTest, ContinuesBitForBitFromASavedState) {
  LqrLaw law(robot_, config_), other(robot_, config_);
  StateVector x = atRest();
  x[kBallX] = 0.2;
  x[kOmegaY + kPositionDim] = 0.1;
  law.plan(simTimeFromNs(1000), x, JointVector::LinSpaced(1, 6));
  law.activatePlan();
  other.restoreState(law.saveState());
  PolicySample a, b;
  law.sample(simTimeFromNs(5000000), a);
  other.sample(simTimeFromNs(5000000), b);
  EXPECT_EQ(a.joint_position, b.joint_position);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.feedback, b.feedback);
  EXPECT_EQ(a.torque, b.torque);
}

TEST_F(LqrLawTest, ComesFromTheFactoryByItsKind) {
  ConfigReader in(tree_);
  EXPECT_NE(dynamic_cast<LqrLaw*>(test::makeControlLaw(in, robot_).get()), nullptr);
}

TEST_F(LqrLawTest, NamesAJointThatCannotReachItsSetPoint) {
  applyOverride(tree_, "lqr.set_point.arm_rad=[0, -0.6, 4]");
  ConfigReader in(tree_);
  try {
    test::makeControlLaw(in, robot_);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("arm_rad puts joint 3"));
    EXPECT_THAT(e.what(), HasSubstr("at 4 rad, must be between 0 and 2.6"));
  }
}

TEST_F(LqrLawTest, ListsTheKindsThereAre) {
  applyOverride(tree_, "kind=magic");
  ConfigReader in(tree_);
  try {
    test::makeControlLaw(in, robot_);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("kind is 'magic', must be one of: lqr"));
  }
}

}  // namespace
}  // namespace ballbot
