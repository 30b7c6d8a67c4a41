#include <cmath>

#include <gtest/gtest.h>

#include "controller/mpc_law.hpp"
#include "core/config_reader.hpp"
#include "core/yaml_file.hpp"
#include "model/frames.hpp"
#include "tests/controller/support/closed_loop.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr auto kLost = static_cast<std::int8_t>(ContactState::kLost);

/// A push, an upright pose and little motion are asked for; where the ball is does not matter.
const char* const kPush =
    "mpc.tasks={contact_force: {weight: 1, reference: {moves: [{at_s: 1, by: [0, 0, 5], over_s: "
    "1}]}},"
    "contact_normal: [-1, 0, 0], ee_orientation: {weight: 20}, yaw: {weight: 20},"
    "ball_velocity: {weight: 10}, arm_rate: {weight: 1}, base_rate: {weight: 4}, wheel_torque: "
    "{weight: 2},"
    "arm_torque: {weight: 0.05}}";

class ContactTest : public testing::Test {
 protected:
  ContactTest() {
    applyOverride(tree_, "mpc.contact_forces=true");
    applyOverride(tree_, kPush);
  }
  MpcConfig config() {
    ConfigReader in(tree_);
    ConfigReader mpc = in.child("mpc");
    return MpcConfig::read(mpc, robot_);
  }
  TrackerConfig tracker() {
    ConfigReader in(tree_);
    ConfigReader tracker = in.child("tracker");
    return TrackerConfig::read(tracker, robot_);
  }
  /// A wall two centimetres in front of the end-effector, there until `until` [s].
  ClosedLoopOptions wallUntil(double until) const {
    ClosedLoopOptions options;
    const double wall = tip_.p_WE.x() + 0.02;
    options.touch = [=](double t, const ReducedDynamics::EndEffector& tip) {
      const double depth = tip.p_WE.x() - wall;
      if (t >= until || depth <= 0) return Vector3(Vector3::Zero());
      const double normal = std::max(0.0, 4000 * depth + 60 * tip.v_WE_W.x());
      return Vector3(-normal, -20 * tip.v_WE_W.y(), -20 * tip.v_WE_W.z());
    };
    return options;
  }

  RobotParameters robot_ = exampleRobot();
  ConfigNode tree_ = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/controllers/mpc.yaml");
  ReducedDynamics dynamics_{robot_};
  StateVector rest_ = findEquilibrium(dynamics_, robot_.nominal_arm).x;
  ReducedDynamics::EndEffector tip_ = dynamics_.endEffector(rest_);
};

TEST_F(ContactTest, PushesAWallAboutAsHardAsAsked) {
  MpcLaw law(robot_, config());
  const ClosedLoopOptions options = wallUntil(100);
  const auto run = runClosedLoop(law, tracker(), robot_, rest_, 8, options);
  ASSERT_NEAR(run.back().time, 8, 1e-3) << "fell";
  double pushed = 0;
  int count = 0;
  for (const auto& s : run) {
    ASSERT_NE(s.plan.contact.state, kLost) << "at " << s.time << " s";
    if (s.time < 5) continue;
    pushed -= options.touch(s.time, dynamics_.endEffector(s.x)).x();
    ++count;
  }
  EXPECT_NEAR(pushed / count, 5, 1.25);
  EXPECT_NEAR(run.back().plan.contact.counted_on_W.x(), -5, 1e-9);
}

TEST_F(ContactTest, DropsTheForceWhenNothingPushesBackAnyMore) {
  MpcLaw law(robot_, config());
  const auto run = runClosedLoop(law, tracker(), robot_, rest_, 10, wallUntil(5));
  ASSERT_NEAR(run.back().time, 10, 1e-3) << "fell";
  double lost_at = 100;
  for (const auto& s : run) {
    if (s.plan.contact.state == kLost) lost_at = std::min(lost_at, s.time);
  }
  EXPECT_GT(lost_at, 5.25);
  EXPECT_LT(lost_at, 5.8);
  EXPECT_LT(run.back().x.segment<2>(kPositionDim + kBallVx).norm(), 0.3) << "runs away";
}

TEST_F(ContactTest, GivesUpWhereThereIsNothingToPush) {
  applyOverride(tree_, "mpc.contact_supervision={approach_limit_s: 0.8}");
  MpcLaw law(robot_, config());
  const auto run = runClosedLoop(law, tracker(), robot_, rest_, 4);
  ASSERT_NEAR(run.back().time, 4, 1e-3) << "fell";
  EXPECT_NE(run[static_cast<std::size_t>(1.5 / LaggedPlant::kStep)].plan.contact.state, kLost);
  EXPECT_EQ(run.back().plan.contact.state, kLost);
}

TEST_F(ContactTest, TheContactFrameTurnsWithTheSignalAndWithTheHinge) {
  TaskSchedule schedule(robot_);
  schedule.contact_turn.ramp(1, 2, Eigen::Matrix<double, 1, 1>(0.5));
  Tasks tasks;
  schedule.at(3, 0, tasks);
  EXPECT_LT((tasks.R_WC.col(2) - Vector3(-std::cos(0.5), -std::sin(0.5), 0)).norm(), 1e-12);
  EXPECT_LT((tasks.R_WC.transpose() * tasks.R_WC - Matrix3::Identity()).norm(), 1e-12);

  // A door on a hinge 0.7 m to the left, pushed open: its free end swings forward and to the left,
  // its normal turns to the right.
  schedule.contact_hinge = Eigen::Vector2d(0.2, 0.7);
  EXPECT_NEAR(schedule.turnAboutHinge({0.2, 0, 1}), 0, 1e-12);
  for (double angle : {0.1, 0.6, 1.2}) {
    const Vector3 tip(0.2 + 0.7 * std::sin(angle), 0.7 - 0.7 * std::cos(angle), 1);
    EXPECT_NEAR(schedule.turnAboutHinge(tip), angle, 1e-12);
    ContactSituation situation;
    situation.turn = schedule.turnAboutHinge(tip);
    schedule.at(0, 0, tasks, situation);
    const Vector3 along = tip - Vector3(0.2, 0.7, 1);
    EXPECT_NEAR(tasks.R_WC.col(2).dot(along), 0, 1e-12);
    EXPECT_LT(tasks.R_WC.col(2).x(), 0);
  }
}

TEST_F(ContactTest, LostContactTurnsTheTasksOffAndNothingElse) {
  const MpcConfig c = config();
  Tasks with, without;
  ContactSituation lost;
  lost.lost = true;
  c.schedule->at(3, 3, with);
  c.schedule->at(3, 3, without, lost);
  EXPECT_TRUE(with.inContact());
  EXPECT_FALSE(without.inContact());
  EXPECT_EQ(with.yaw_weight, without.yaw_weight);
  EXPECT_EQ(with.ee_orientation_weight, without.ee_orientation_weight);
}

TEST_F(ContactTest, WithMomentsThePlanTwistsAsAsked) {
  applyOverride(tree_, "mpc.contact_moments=true");
  applyOverride(tree_, "mpc.tasks.contact_moment={weight: 5, reference: {initial: [0, 0, 0.5]}}");
  MpcConfig c = config();
  const auto engine = makeEngine(robot_, c);
  const LqrSolution lqr = designLqr(dynamics_, robot_.nominal_arm, LqrWeights{});
  MpcPolicy seed = engine->emptyPolicy(), plan = seed;
  MpcState x0;
  x0 << rest_, Vector3::Zero();
  for (auto& knot : seed.knots()) knot.x = x0;
  for (auto& control : seed.controls()) {
    control.u << lqr.equilibrium.tau, ContactInput::Zero();
    control.K.topLeftCorner<kJointCount, kStateDim>() = lqr.K;
  }
  seed.setValid(simTimeFromNs(3'000'000'000));
  ASSERT_TRUE(engine->solve(simTimeFromNs(3'000'000'000), x0, seed, 30, plan).ok());
  const Vector3 moment = plan.controls().back().u.tail<3>();
  EXPECT_NEAR(moment.z(), 0.5, 0.2);
  const Vector3 force = plan.controls().back().u.segment<3>(kJointCount);
  EXPECT_NEAR(force.z(), 5, 1);
}

}  // namespace
}  // namespace ballbot
