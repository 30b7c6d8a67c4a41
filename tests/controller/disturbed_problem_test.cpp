#include "controller/disturbed_problem.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "controller/floor_limited_problem.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr int NU = 6;
using Problem = DisturbedProblem<NU>;
using X = Problem::X;
using U = Problem::U;
using Stage = Problem::Stage;

/// A robot with a force on it that lasts, and the problem that knows of it.
class DisturbedProblemTest : public testing::Test {
 protected:
  DisturbedProblemTest() {
    force_ << 6, -4, 1.5, -3, 0.2, 0.1, -4, 2;
    StateVector at = findEquilibrium(dynamics_, robot_.nominal_arm).x;
    at[kYaw] = 0.4;
    EXPECT_TRUE(findLastingLoad(dynamics_, at, force_, load_));
    for (int k = 0; k <= inner_.stages(); ++k) {
      inner_.tasks(k).wheel_torque_weight = 2;
      inner_.tasks(k).arm_torque_weight = 0.05;
    }
    problem_.setInner(limited_);
    problem_.setLoad(load_);
    x_ << load_.x, load_.torque.head<kFilterDim>();
    u_ = load_.torque;
  }

  RobotParameters robot_ = exampleRobot();
  ReducedDynamics dynamics_{robot_};
  FrequencyShaping shaping_{100, 200};
  std::vector<double> knots_{0, 0.02, 0.05};
  WholeBodyProblem<NU> inner_{robot_, Constraints(robot_), shaping_, TerminalCost{}, knots_};
  FloorLimitedProblem<NU> limited_{robot_, Constraints(robot_), knots_, inner_};
  DisturbedProblem<NU> problem_{shaping_, knots_, inner_};
  VelocityVector force_;
  LastingLoad load_;
  X x_;
  U u_;
};

TEST_F(DisturbedProblemTest, AtItsRestTheRobotStays) {
  X next;
  for (int k = 0; k < problem_.stages(); ++k) {
    problem_.step(k, x_, u_, next);
    EXPECT_LT((next - x_).cwiseAbs().maxCoeff(), 1e-9) << k;
  }
  inner_.step(0, x_, u_, next);
  EXPECT_GT((next - x_).cwiseAbs().maxCoeff(), 1e-3) << "without the force it would not";
}

// Against the continuous equations with the same force, integrated finely.
TEST_F(DisturbedProblemTest, AStepIsTheMotionUnderTheForce) {
  u_ += U::Constant(0.3);
  x_.segment<kVelocityDim>(kPositionDim).setConstant(0.05);
  const auto rate = [&](const StateVector& x) {
    StateVector dx = dynamics_.derivative(x, u_, Vector3::Zero());
    dx.tail<kVelocityDim>() += dynamics_.massMatrix(x.head<kPositionDim>()).ldlt().solve(force_);
    return dx;
  };
  StateVector x = x_.head<kStateDim>();
  const double h = 0.02 / 200;
  for (int i = 0; i < 200; ++i) x += h * rate(x + 0.5 * h * rate(x));
  X next;
  problem_.step(0, x_, u_, next);
  const double moved = (x - x_.head<kStateDim>()).norm();
  EXPECT_LT((next.head<kStateDim>() - x).norm(), 0.02 * moved);
}

TEST_F(DisturbedProblemTest, WheelTorquesCostAsTheyDifferFromThoseOfStandingStill) {
  const auto torqueCost = [&](const U& u, const X& x) {
    CostTerms terms;
    problem_.addCost(0, x, u, terms);
    return terms.value[kWheelTorqueCost];
  };
  // 1/2 w H s^2 of each, whatever the force: s is what differs.
  U same = u_;
  same.head<kWheelCount>() -= load_.shift.head<kWheelCount>();
  CostTerms without;
  X filtered = x_;
  filtered.tail<kFilterDim>() -= load_.shift.head<kWheelCount>();
  inner_.addCost(0, filtered, same, without);
  EXPECT_NEAR(torqueCost(u_, x_), without.value[kWheelTorqueCost], 1e-12);
}

TEST_F(DisturbedProblemTest, GradientsAreCentralDifferences) {
  u_ += U::LinSpaced(-0.5, 0.7);
  x_.tail<kFilterDim>() += Vector3(0.2, -0.1, 0.3);
  Stage lq;
  CostTerms terms, expected;
  problem_.approximate(0, 1, &x_, &u_, &terms, &lq);
  problem_.addCost(0, x_, u_, expected);
  EXPECT_NEAR(terms.total(), expected.total(), 1e-12);
  const auto cost = [&](const X& x, const U& u) {
    CostTerms c;
    problem_.addCost(0, x, u, c);
    return c.total();
  };
  const double h = 1e-5;
  for (int i = 0; i < kMpcStateDim; ++i) {
    X a = x_, b = x_;
    a[i] += h;
    b[i] -= h;
    EXPECT_NEAR(lq.q()[i], (cost(a, u_) - cost(b, u_)) / (2 * h), 1e-7) << "state " << i;
  }
  for (int i = 0; i < NU; ++i) {
    U a = u_, b = u_;
    a[i] += h;
    b[i] -= h;
    EXPECT_NEAR(lq.r()[i], (cost(x_, a) - cost(x_, b)) / (2 * h), 1e-7) << "input " << i;
  }
}

TEST_F(DisturbedProblemTest, TheSameHoldsInContinuousTime) {
  auto schedule = std::make_shared<TaskSchedule>(robot_);
  schedule->wheel_torque_weight = TimedWeight<1>(Eigen::Matrix<double, 1, 1>(2));
  ContinuousProblem<NU> inner(robot_, Constraints(robot_), shaping_, TerminalCost{}, schedule);
  DisturbedContinuousProblem<NU> problem(shaping_, inner);
  inner.setHorizon(0, {}, {});
  problem.setTime(0);
  problem.setLoad(load_);
  X dx;
  problem.flow(x_, u_, dx);
  EXPECT_LT(dx.cwiseAbs().maxCoeff(), 1e-9);
  u_ += U::LinSpaced(-0.5, 0.7);
  DisturbedContinuousProblem<NU>::Expansion lq;
  problem.expand(x_, u_, dx, lq);
  X flow;
  problem.flow(x_, u_, flow);
  EXPECT_LT((dx - flow).cwiseAbs().maxCoeff(), 1e-12);
  const double h = 1e-5;
  for (int i = 0; i < NU; ++i) {
    CostTerms a, b;
    U up = u_, down = u_;
    up[i] += h;
    down[i] -= h;
    problem.addCostRate(x_, up, a);
    problem.addCostRate(x_, down, b);
    EXPECT_NEAR(lq.r()[i], (a.total() - b.total()) / (2 * h), 1e-6) << i;
  }
  for (int i = kStateDim; i < kMpcStateDim; ++i) {
    CostTerms a, b;
    X up = x_, down = x_;
    up[i] += h;
    down[i] -= h;
    problem.addCostRate(up, u_, a);
    problem.addCostRate(down, u_, b);
    EXPECT_NEAR(lq.q()[i], (a.total() - b.total()) / (2 * h), 1e-6) << i;
  }
}

}  // namespace
}  // namespace ballbot
