#include <array>

#include <gtest/gtest.h>

#include "solver/slq_solver_impl.hpp"
#include "tests/solver/support/allocation_counter.hpp"
#include "tests/solver/support/cart_pole.hpp"
#include "tests/solver/support/linear_quadratic_problem.hpp"

namespace ballbot {
namespace {

struct NoViolation {
  static constexpr int kCount = 1;
  std::array<double, 1> value{};
  double total() const { return value[0]; }
  NoViolation& operator+=(const NoViolation&) { return *this; }
};
struct IntegerViolation : NoViolation {
  int violation = 0;
};
struct Complete : NoViolation {
  double violation = 0;
};
static_assert(IsCost<ScalarCost>::value && IsCost<Complete>::value);
static_assert(!IsCost<double>::value && !IsCost<NoViolation>::value &&
              !IsCost<IntegerViolation>::value);

using LinearSolver = SlqSolver<4, 2, ScalarCost>;
using CartPoleSolver = SlqSolver<4, 1, ScalarCost>;

template <typename Solver>
void startFrom(Solver& solver, const Eigen::Vector4d& x0) {
  for (auto& x : solver.nominal().x) x = x0;
  for (auto& u : solver.nominal().u) u.setZero();
  for (auto& gain : solver.nominal().gain) gain.K().setZero();
}

TEST(SlqSolver, RaisesItsRegularisationWhereTheInputHessianIsNotPositive) {
  LinearQuadraticProblem<4, 2> problem(5, 1);
  problem.R.setZero();
  problem.R(0, 0) = -2;
  problem.B *= 0.01;
  problem.Pt.setZero();
  LinearSolver solver(5, SlqOptions{});
  startFrom(solver, Eigen::Vector4d::Zero());
  const auto report = solver.iterate(problem, Eigen::Vector4d::Ones());
  EXPECT_TRUE(report.ok());
  EXPECT_GT(report.shift, 1);
}

TEST(SlqSolver, SaysThatTheNominalRolloutDiverged) {
  LinearQuadraticProblem<4, 2> problem(400, 1);
  problem.A *= 100;
  LinearSolver solver(400, SlqOptions{});
  startFrom(solver, Eigen::Vector4d::Zero());
  const auto report = solver.iterate(problem, Eigen::Vector4d::Ones());
  EXPECT_EQ(report.status, SlqStatus::kNotFinite);
  EXPECT_FALSE(report.ok());
}

TEST(SlqSolver, TwoThreadsGiveTheBitsOfOneOnAUsersProblem) {
  const DiscretisedProblem<CartPole> problem(CartPole{}, 103, 0.02);
  SlqOptions two;
  two.threads = 2;
  CartPoleSolver one_thread(problem.stages(), SlqOptions{}), two_threads(problem.stages(), two);
  for (CartPoleSolver* solver : {&one_thread, &two_threads}) {
    startFrom(*solver, CartPole::hanging());
    ASSERT_TRUE(solver->converge(problem, CartPole::hanging(), 30, 1e-9).ok());
  }
  for (int k = 0; k < problem.stages(); ++k) {
    ASSERT_EQ(one_thread.solution().x[k + 1], two_threads.solution().x[k + 1]);
    ASSERT_EQ(one_thread.solution().u[k], two_threads.solution().u[k]);
    ASSERT_EQ(one_thread.solution().gain[k].K(), two_threads.solution().gain[k].K());
  }
}

TEST(SlqSolver, IterationsOnAUsersProblemDoNotAllocate) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  const DiscretisedProblem<CartPole> problem(CartPole{}, 100, 0.02);
  for (const int threads : {1, 2}) {
    SlqOptions options;
    options.threads = threads;
    CartPoleSolver solver(problem.stages(), options);
    startFrom(solver, CartPole::hanging());
    ASSERT_TRUE(solver.iterate(problem, CartPole::hanging()).ok());  // the helper has started
    const auto before = allocationCount();
    const auto one = solver.iterate(problem, CartPole::hanging());
    const auto more = solver.converge(problem, CartPole::hanging(), 10, 1e-9);
    EXPECT_EQ(allocationCount(), before) << threads << " threads";
    EXPECT_TRUE(one.ok());
    EXPECT_TRUE(more.ok());
  }
}

}  // namespace
}  // namespace ballbot
