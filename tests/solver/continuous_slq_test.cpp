#include "solver/continuous_slq.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/continuous_slq_impl.hpp"
#include "solver/sampled_policy.hpp"
#include "solver/scalar_cost.hpp"

namespace ballbot {
namespace {

/// A mass pushed along a line, dx/dt = v, dv/dt = u, at the cost 1/2 (q1 x^2 + q2 v^2 + u^2): over
/// a long horizon K = -(sqrt(q1), sqrt(q2 + 2 sqrt(q1))).
class PushedMass final : public ContinuousControlProblem<2, 1, ScalarCost> {
 public:
  static constexpr double q1 = 4, q2 = 0.5;

  void setTime(double) noexcept override {}
  void flow(const X& x, const U& u, X& dx) const noexcept override { dx << x[1], u[0]; }
  void addCostRate(const X& x, const U& u, ScalarCost& cost) const noexcept override {
    cost.add(0.5 * (q1 * x[0] * x[0] + q2 * x[1] * x[1] + u[0] * u[0]));
    cost.require(1 - x[0]);
  }
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override {
    flow(x, u, dx);
    out.A() << 0, 1, 0, 0;
    out.B() << 0, 1;
    out.Q() << q1, 0, 0, q2;
    out.q() << q1 * x[0], q2 * x[1];
    out.R() << 1;
    out.r() = u;
  }
  void addFinalCost(const X&, ScalarCost&) const noexcept override {}
  void expandFinalCost(const X&, ValueFunction<2>& value) const noexcept override {
    value.set(Eigen::Matrix2d::Zero(), X::Zero(), 0);
  }
};

class ContinuousSlqTest : public testing::Test {
 protected:
  ContinuousSlqTest() {
    for (int k = 0; k <= 200; ++k) knots_.push_back(0.05 * k);
    SlqOptions options;
    options.base_shift = 0;
    solver_ =
        std::make_unique<ContinuousSlq<2, 1, ScalarCost>>(knots_, options, ContinuousOptions{1e-8});
    guess_ = std::make_unique<SampledPolicy<2, 1>>(knots_, knots_);
  }
  std::vector<double> knots_;
  PushedMass problem_;
  std::unique_ptr<ContinuousSlq<2, 1, ScalarCost>> solver_;
  std::unique_ptr<SampledPolicy<2, 1>> guess_;
};

TEST_F(ContinuousSlqTest, FindsTheGainsAndTheCostOfTheAlgebraicEquation) {
  const Eigen::Vector2d x0(1.5, 0);
  const auto report = solver_->solve(problem_, x0, *guess_, 0, 5);
  ASSERT_TRUE(report.ok()) << slqStatusName(report.status);
  const double k1 = std::sqrt(PushedMass::q1), k2 = std::sqrt(PushedMass::q2 + 2 * k1);
  const auto& solution = solver_->solution();
  EXPECT_NEAR(solution.gain[0].K()(0), -k1, 1e-5);
  EXPECT_NEAR(solution.gain[0].K()(1), -k2, 1e-5);
  EXPECT_NEAR(solution.u[0][0], -k1 * x0[0], 1e-4);
  EXPECT_NEAR(report.cost, 0.5 * k1 * k2 * x0[0] * x0[0], 1e-5);  // x0^T S x0 / 2
  EXPECT_NEAR(report.terms.violation, 0.5, 1e-12);
  EXPECT_LT(solution.x.back().norm(), 1e-3);
}

TEST_F(ContinuousSlqTest, EqualInputsGiveEqualBitsWhateverWasSolvedBefore) {
  ContinuousSlq<2, 1, ScalarCost> fresh(knots_, SlqOptions{}, ContinuousOptions{1e-8});
  solver_->setShift(fresh.shift());
  ASSERT_TRUE(solver_->solve(problem_, Eigen::Vector2d(-2, 1), *guess_, 0, 3).ok());
  solver_->setShift(fresh.shift());
  const Eigen::Vector2d x0(1, 0);
  ASSERT_TRUE(fresh.solve(problem_, x0, *guess_, 0, 1).ok());
  ASSERT_TRUE(solver_->solve(problem_, x0, *guess_, 0, 1).ok());
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    ASSERT_EQ(solver_->solution().x[k], fresh.solution().x[k]);
    ASSERT_EQ(solver_->solution().u[k], fresh.solution().u[k]);
  }
}

}  // namespace
}  // namespace ballbot
