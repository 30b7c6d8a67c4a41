#include "tests/solver/support/planar_quadrotor.hpp"

#include <gtest/gtest.h>

#include "solver/slq_solver_impl.hpp"
#include "tests/solver/support/derivative_check.hpp"

namespace ballbot {
namespace {

using Solver = SlqSolver<6, 2, ScalarCost>;
using Problem = DiscretisedProblem<PlanarQuadrotor>;
using X = PlanarQuadrotor::X;
using U = PlanarQuadrotor::U;

TEST(PlanarQuadrotorProblem, DerivativesAreCentralDifferences) {
  PlanarQuadrotor model;
  const X x = (X() << -0.9, 0.7, 1.2, 2, -0.5, 3).finished();
  for (const U& u : {U(2, 3), U(-0.2, 4.95)}) {  // inside the bounds and beyond
    expectDerivativesOf(Problem(model, 1, 0.02), x, u, 1e-6, Hessian::kOfInputsOnly);
    model.radius = 0;
    expectDerivativesOf(Problem(model, 1, 0.02), x, u, 1e-6);
  }
}

TEST(PlanarQuadrotorProblem, OneStepIsTheMotionIntegratedFinely) {
  const PlanarQuadrotor model;
  const Problem problem(model, 1, 0.02);
  const X x = (X() << 0, 0, 0.8, 1, -2, 5).finished();
  X next;
  problem.step(0, x, U(1, 4), next);
  EXPECT_LT((next - model.moved(x, U(1, 4), 0.02)).cwiseAbs().maxCoeff(), 1e-5);
}

class PlanarQuadrotorFlight : public testing::Test {
 protected:
  static constexpr int kStages = 150;

  PlanarQuadrotorFlight() {
    for (auto& x : solver_.nominal().x) x = start();
    for (auto& u : solver_.nominal().u) u = model_.hover();
  }
  /// Hovering, the disc between here and the goal.
  static X start() { return (X() << -2, 0, 0, 0, 0, 0).finished(); }

  /// Follows the plan with its feedback; the motion is integrated independently.
  template <typename See>
  X fly(const See& see) const {
    const auto& plan = solver_.solution();
    X x = start();
    for (int k = 0; k < kStages; ++k) {
      const U u = plan.u[k] + plan.gain[k].K() * (x - plan.x[k]);
      see(x, u);
      x = model_.moved(x, u, problem_.stepLength());
    }
    return x;
  }

  const PlanarQuadrotor model_;
  const Problem problem_{model_, kStages, 0.02};
  Solver solver_{kStages, SlqOptions{}};
};

TEST_F(PlanarQuadrotorFlight, GoesRoundTheObstacleToThePoseWithinItsThrusts) {
  const auto report = solver_.converge(problem_, start(), 300, 1e-8);
  ASSERT_EQ(report.status, SlqStatus::kConverged) << slqStatusName(report.status);
  EXPECT_EQ(report.terms.violation, 0);
  double least_clearance = 1e9, least_thrust = 1e9, largest_thrust = 0;
  const X end = fly([&](const X& x, const U& u) {
    least_clearance = std::min(least_clearance, model_.clearance(x));
    least_thrust = std::min(least_thrust, u.minCoeff());
    largest_thrust = std::max(largest_thrust, u.maxCoeff());
  });
  EXPECT_LT((end - model_.goal).head<3>().cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((end - model_.goal).tail<3>().cwiseAbs().maxCoeff(), 0.1);
  EXPECT_GT(least_clearance, 0);
  EXPECT_LT(least_clearance, 0.3);  // it does go round, and no farther than it must
  EXPECT_GE(least_thrust, 0);
  EXPECT_LE(largest_thrust, model_.largest_thrust);
}

TEST_F(PlanarQuadrotorFlight, WithoutTheBarrierTheStraightWayLeadsThroughTheObstacle) {
  PlanarQuadrotor blind = model_;
  blind.radius = 0;
  ASSERT_TRUE(solver_.converge(Problem(blind, kStages, 0.02), start(), 300, 1e-8).ok());
  double least_clearance = 1e9;
  fly([&](const X& x, const U&) {
    least_clearance = std::min(least_clearance, model_.clearance(x));
  });
  EXPECT_LT(least_clearance, -0.2);
}

}  // namespace
}  // namespace ballbot
