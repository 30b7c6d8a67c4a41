#include "controller/mpc_planner.hpp"

#include <gtest/gtest.h>

#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

class MpcPlannerTest : public testing::Test {
 protected:
  MpcConfig config() {
    ConfigNode tree = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/controllers/mpc.yaml");
    ConfigReader in(tree);
    ConfigReader mpc = in.child("mpc");
    return MpcConfig::read(mpc, robot_);
  }
  PolicySample standIn() const {
    PolicySample out;
    out.x = x_;
    out.torque = equilibrium_.tau;
    return out;
  }
  PlanReport plan(MpcPlanner& planner, double at_ms, const MpcPolicy& previous, MpcPolicy& out) {
    const SimTime now = kSimStart + SimDuration{static_cast<std::int64_t>(at_ms * 1e6)};
    JointVector joints = JointVector::Zero();
    joints.tail<kArmJointCount>() = robot_.nominal_arm;
    return planner.plan(now, x_, Vector3::Zero(), joints, standIn(), previous, out);
  }

  RobotParameters robot_ = exampleRobot();
  Equilibrium equilibrium_ = findEquilibrium(ReducedDynamics(robot_), robot_.nominal_arm);
  StateVector x_ = equilibrium_.x;
};

TEST_F(MpcPlannerTest, BeginsAnewAtOnceWhereTheLastPlanLeadsNowhere) {
  MpcPlanner planner(robot_, config());
  MpcPolicy first = planner.emptyPolicy(), second = planner.emptyPolicy();
  ASSERT_TRUE(plan(planner, 0, MpcPolicy(), first).accepted);
  for (auto& control : first.controls()) control.K *= -3;  // drives away from where it wants to be
  x_[kRoll] += 0.05;
  const PlanReport report = plan(planner, 14, first, second);
  EXPECT_TRUE(report.accepted);
  EXPECT_GT(report.iterations, 1);
  EXPECT_LT(second.stateAt(0.8).head<kPositionDim>().cwiseAbs().tail<3>().maxCoeff(), 3);
  EXPECT_NEAR(second.stateAt(0.8)[kRoll], equilibrium_.x[kRoll], 0.03);
}

}  // namespace
}  // namespace ballbot
