#include "tests/solver/support/cart_pole.hpp"

#include <gtest/gtest.h>

#include "solver/slq_solver_impl.hpp"
#include "tests/solver/support/derivative_check.hpp"

namespace ballbot {
namespace {

using Solver = SlqSolver<4, 1, ScalarCost>;
using Problem = DiscretisedProblem<CartPole>;

TEST(CartPoleProblem, DerivativesAreCentralDifferences) {
  const Problem problem(CartPole{}, 1, 0.02);
  for (const double angle : {0.0, 0.7, 2.5, M_PI}) {
    expectDerivativesOf(problem, Eigen::Vector4d(0.3, angle, -0.8, 3.1),
                        Problem::U(Problem::U::Constant(4.2)), 1e-7);
  }
}

TEST(CartPoleProblem, OneStepIsTheMotionIntegratedFinely) {
  const CartPole model;
  const Problem problem(model, 1, 0.02);
  const Eigen::Vector4d x(0.1, 2.2, 0.5, -4);
  Eigen::Vector4d next;
  problem.step(0, x, Problem::U::Constant(-6), next);
  EXPECT_LT((next - model.moved(x, -6, 0.02)).cwiseAbs().maxCoeff(), 1e-5);
}

class CartPoleSwingUp : public testing::Test {
 protected:
  static constexpr int kStages = 150;
  const CartPole model_;
  const Problem problem_{model_, kStages, 0.02};

  /// From hanging, every force zero.
  static void seed(Solver& solver) {
    for (auto& x : solver.nominal().x) x = CartPole::hanging();
    for (auto& u : solver.nominal().u) u.setZero();
  }
};

TEST_F(CartPoleSwingUp, ConvergesWithAFallingCost) {
  Solver solver(kStages, SlqOptions{});
  seed(solver);
  std::vector<double> costs;
  const auto report = solver.converge(problem_, CartPole::hanging(), 300, 1e-8, &costs);
  EXPECT_EQ(report.status, SlqStatus::kConverged) << slqStatusName(report.status);
  ASSERT_GT(costs.size(), 3U);
  for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_LE(costs[i], costs[i - 1] * (1 + 1e-10));
}

TEST_F(CartPoleSwingUp, EndsUprightAndAtRestWhenTheMotionIsIntegratedIndependently) {
  Solver solver(kStages, SlqOptions{});
  seed(solver);
  ASSERT_TRUE(solver.converge(problem_, CartPole::hanging(), 300, 1e-8).ok());
  const auto& plan = solver.solution();
  Eigen::Vector4d x = CartPole::hanging();
  double largest_force = 0;
  for (int k = 0; k < kStages; ++k) {
    const double force = (plan.u[k] + plan.gain[k].K() * (x - plan.x[k]))[0];
    largest_force = std::max(largest_force, std::abs(force));
    x = model_.moved(x, force, problem_.stepLength());
  }
  EXPECT_NEAR(x[0], 0, 0.02);
  EXPECT_NEAR(x[1], 0, 0.02);
  EXPECT_NEAR(x[2], 0, 0.1);
  EXPECT_NEAR(x[3], 0, 0.1);
  EXPECT_LT((x - plan.x.back()).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT(largest_force, 1);  // something was done
}

}  // namespace
}  // namespace ballbot
