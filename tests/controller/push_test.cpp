#include <gtest/gtest.h>

#include "controller/mpc_planner.hpp"
#include "controller/push_belief.hpp"
#include "controller/pushed_problem.hpp"
#include "tests/controller/support/lqr_seed.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

SimTime at(double ms) { return simTimeFromNs(static_cast<std::int64_t>(ms * 1e6)); }

VelocityVector alongX(double force) {
  VelocityVector out = VelocityVector::Zero();
  out[kBallVx] = force;
  out[kOmegaZ] = 3;
  return out;
}

TEST(PushEstimate, BeginsAtZeroAndIsWholeAtHalfAsMuchAgain) {
  PushEstimate push(PushBelief{});
  const double least = push.settings().least_force;
  push.update(at(0), alongX(least), false);
  EXPECT_EQ(push.force(), VelocityVector(VelocityVector::Zero()));
  push.update(at(2.5), alongX(1.001 * least), false);
  EXPECT_NEAR(push.force()[kBallVx], 0, 0.01 * least);
  push.update(at(5), alongX(1.5 * least), false);
  EXPECT_DOUBLE_EQ(push.force()[kBallVx], 1.5 * least);
  EXPECT_EQ(push.force()[kOmegaZ], 0);
  push.update(at(7.5), alongX(0), false);
  EXPECT_TRUE(push.force().isZero(0));
}

TEST(PushEstimate, IsNothingAfterAMeasurementWasRefusedAndUnlessAskedFor) {
  PushEstimate push(PushBelief{});
  push.update(at(0), alongX(60), true);
  push.update(at(147.5), alongX(60), false);
  EXPECT_TRUE(push.force().isZero(0));
  push.update(at(150), alongX(60), false);
  EXPECT_DOUBLE_EQ(push.force()[kBallVx], 60);
  PushBelief ignored;
  ignored.counted_on = false;
  PushEstimate unasked(ignored);
  unasked.update(at(0), alongX(60), false);
  EXPECT_TRUE(unasked.force().isZero(0));
}

class PushedPlan : public testing::Test {
 protected:
  PushedPlan() : config_(robot_) {
    config_.horizon.length = 0.6;
    auto tasks = std::make_shared<TaskSchedule>(robot_);
    tasks->ball_position_weight = TimedWeight<2>(Eigen::Vector2d::Constant(100));
    tasks->ball_velocity_weight = TimedWeight<2>(Eigen::Vector2d::Constant(10));
    tasks->base_rate_weight = TimedWeight<3>(Vector3::Constant(4));
    tasks->arm_rate_weight = TimedWeight<3>(Vector3::Constant(0.5));
    tasks->yaw_weight = TimedWeight<1>(Eigen::Matrix<double, 1, 1>(20));
    tasks->wheel_torque_weight = TimedWeight<1>(Eigen::Matrix<double, 1, 1>(2));
    tasks->arm_torque_weight = TimedWeight<1>(Eigen::Matrix<double, 1, 1>(0.1));
    config_.schedule = tasks;
    x0_ << lqr_.equilibrium.x, Vector3::Zero();
  }
  MpcSolveReport converged(MpcConfig::Engine kind, double step, const Push& push, MpcPolicy& out) {
    config_.engine = kind;
    config_.horizon.coarse_step = step;
    const auto engine = makeEngine(robot_, config_);
    PlanConditions pushed;
    pushed.push = push;
    engine->setConditions(pushed);
    out = engine->emptyPolicy();
    return engine->solve(kSimStart, x0_, lqrSeed(*engine, lqr_), 60, out);
  }

  RobotParameters robot_ = exampleRobot();
  ReducedDynamics dynamics_{robot_};
  LqrSolution lqr_ = designLqr(dynamics_, robot_.nominal_arm, LqrWeights{});
  MpcConfig config_;
  MpcState x0_;
};

// The model knows one push by itself: a force on the end-effector.
TEST_F(PushedPlan, AcceleratesAsTheModelDoesUnderTheSameForce) {
  StateVector x = lqr_.equilibrium.x;
  x[kYaw] = 0.7;
  x[kRoll] = 0.1;
  x[kPositionDim + kOmegaY] = 0.4;
  const PositionVector q = x.head<kPositionDim>();
  const VelocityVector nu = x.tail<kVelocityDim>();
  const Vector3 force_W(12, -7, 4);
  const VelocityVector generalised =
      dynamics_.endEffectorJacobian(q).topRows<3>().transpose() * force_W;
  const VelocityVector expected =
      dynamics_.acceleration(q, nu, lqr_.equilibrium.tau, force_W) -
      dynamics_.acceleration(q, nu, lqr_.equilibrium.tau, Vector3::Zero());
  const Push push = Push::on(dynamics_, q, generalised, 0.3);
  EXPECT_TRUE(push.acts);
  EXPECT_LT((push.acceleration - expected).norm(), 1e-10 * expected.norm());
  EXPECT_FALSE(Push::on(dynamics_, q, VelocityVector::Zero(), 0.3).acts);
}

TEST_F(PushedPlan, FadesByItsTimeConstant) {
  Push push;
  push.acceleration.setConstant(2);
  push.lasts = 0.3;
  double change = 0;
  for (int k = 0; k < 50; ++k) change += 0.02 * push.meanAcceleration(0.02 * k, 0.02)[0];
  EXPECT_NEAR(change, 2 * 0.3 * (1 - std::exp(-1 / 0.3)), 1e-12);
  EXPECT_NEAR(push.meanAcceleration(0.1, 1e-6)[0], 2 * std::exp(-0.1 / 0.3), 1e-5);
}

TEST_F(PushedPlan, IsTheSameInBothEnginesAndLetsTheBallRunAhead) {
  VelocityVector on_base = VelocityVector::Zero();  // 40 N along x, 0.35 m above the ball's centre
  on_base[kBallVx] = 40;
  on_base[kOmegaY] = 14;
  const Push push = Push::on(dynamics_, x0_.head<kPositionDim>(), on_base, 0.5);
  MpcPolicy discrete, continuous;
  const MpcSolveReport a = converged(MpcConfig::Engine::kDiscrete, 0.0025, push, discrete);
  const MpcSolveReport b = converged(MpcConfig::Engine::kContinuous, 0.01, push, continuous);
  ASSERT_TRUE(a.ok());
  ASSERT_TRUE(b.ok());
  EXPECT_NEAR(a.cost, b.cost, 5e-3 * b.cost);
  for (double t = 0.1; t <= 0.6; t += 0.1) {
    EXPECT_LT(
        (discrete.stateAt(t) - continuous.stateAt(t)).head<kPositionDim>().cwiseAbs().maxCoeff(),
        0.02)
        << "at " << t << " s";
  }
  EXPECT_GT(discrete.stateAt(0.4)[kBallX], 0.02);
}

}  // namespace
}  // namespace ballbot
