#include "solver/real_time_iteration.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "solver/riccati_equation_impl.hpp"
#include "solver/sampled_policy.hpp"
#include "solver/slq_solver_impl.hpp"
#include "tests/solver/support/allocation_counter.hpp"
#include "tests/solver/support/cart_pole.hpp"

namespace ballbot {
namespace {

using Iteration = RealTimeIteration<4, 1, ScalarCost>;
using Policy = SampledPolicy<4, 1>;
using Problem = DiscretisedProblem<CartPole>;

TEST(SampledPolicy, IsLinearBetweenItsSamplesAndConstantOutside) {
  Policy policy({0, 1, 3}, {0.5, 2});
  FeedbackTrajectory<4, 1> trajectory;
  trajectory.reset(3, 2);
  trajectory.x[1] << 1, 2, 3, 4;
  trajectory.x[2] << 5, 6, 7, 8;
  trajectory.u[0] << 10;
  trajectory.u[1] << 16;
  trajectory.gain[1].K() << 2, 0, 0, 4;
  policy.set(trajectory);
  EXPECT_EQ(policy.stateAt(-1), trajectory.x[0]);
  EXPECT_EQ(policy.stateAt(2), Eigen::Vector4d(3, 4, 5, 6));
  EXPECT_EQ(policy.stateAt(9), trajectory.x[2]);
  Policy::U u;
  Policy::Gain K;
  policy.controlAt(1, u, K);
  EXPECT_DOUBLE_EQ(u[0], 12);
  EXPECT_DOUBLE_EQ(K[3], 4.0 / 3);
  // 16 + 2 (9 - 5) + 4 (9 - 8)
  EXPECT_DOUBLE_EQ(policy.input(3, Eigen::Vector4d(9, 6, 7, 9))[0], 28);
}

TEST(RealTimeIteration, RefusesAProblemOfAnotherLengthWithBothNumbers) {
  const CartPole model;
  const Problem problem(model, 3, 0.1);
  EXPECT_NO_THROW(Iteration({0, 0.1, 0.2, 0.3}, problem, SlqOptions{}));
  try {
    Iteration({0, 0.1, 0.2}, problem, SlqOptions{});
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("made for 2 stages, its problem has 3"));
  }
}

/// A cart-pole that is let go far from upright and planned anew all the time.
class RealTimeIterationTest : public testing::Test {
 protected:
  RealTimeIterationTest() {
    for (int k = 0; k <= kStages; ++k) knots_.push_back(kStep * k);
    iteration_ = std::make_unique<Iteration>(knots_, SlqOptions{});
  }
  /// Beginning from the LQR's feedback.
  Policy firstPlan(const Eigen::Vector4d& x0) {
    Eigen::Matrix4d A;
    Eigen::Vector4d B;
    model_.linearize(Eigen::Vector4d::Zero(), Problem::U::Zero(), A, B);
    const Eigen::Matrix4d G = B * B.transpose() / model_.force_weight;
    const Eigen::Matrix4d S = solveContinuousRiccati<4>(A, G, model_.weight.asDiagonal());
    FeedbackTrajectory<4, 1> lqr;
    lqr.reset(kStages + 1, kStages);
    for (auto& gain : lqr.gain) gain.K() = -B.transpose() * S / model_.force_weight;
    Policy policy(iteration_->knots(), iteration_->controlTimes());
    policy.set(lqr);
    const auto report = iteration_->solve(problem_, x0, policy, 0, 100);
    EXPECT_EQ(report.status, SlqStatus::kConverged) << slqStatusName(report.status);
    policy.set(iteration_->solution());
    return policy;
  }
  static constexpr int kStages = 60;
  static constexpr double kStep = 0.02;
  const CartPole model_;
  const Problem problem_{model_, kStages, kStep};
  std::vector<double> knots_;
  std::unique_ptr<Iteration> iteration_;
};

TEST_F(RealTimeIterationTest, OneIterationEverySevenMillisecondsBalancesThePole) {
  Eigen::Vector4d x(0.3, 0.3, 0, -0.5);
  Policy policy = firstPlan(x);
  constexpr double kPeriod = 0.007;  // no multiple of the steps
  for (int i = 0; i < 700; ++i) {
    for (int j = 0; j < 7; ++j) {
      x = model_.moved(x, policy.input(1e-3 * j, x)[0], 1e-3);
    }
    if (i == 350) x[3] += 2;  // a push
    const auto report = iteration_->solve(problem_, x, policy, kPeriod, 1);
    ASSERT_TRUE(report.ok()) << i << ": " << slqStatusName(report.status);
    policy.set(iteration_->solution());
    if (i == 349 || i == 699) {
      EXPECT_LT(x.cwiseAbs().maxCoeff(), 0.02) << i;
    }
  }
}

TEST_F(RealTimeIterationTest, OfTheSolutionAtTheSameInstantChangesNothing) {
  const Eigen::Vector4d x(0.1, 0.3, 0, 0);
  const Policy policy = firstPlan(x);
  const auto before = iteration_->solution();
  const auto report = iteration_->solve(problem_, x, policy, 0, 1);
  EXPECT_EQ(report.status, SlqStatus::kConverged);
  for (int k = 0; k < kStages; ++k) {
    ASSERT_NEAR(iteration_->solution().u[k][0], before.u[k][0], 1e-4);
  }
}

TEST_F(RealTimeIterationTest, DoesNotAllocate) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  Policy policy(iteration_->knots(), iteration_->controlTimes());
  const Eigen::Vector4d x(0.1, 0.3, 0, 0);
  const auto before = allocationCount();
  const auto first = iteration_->solve(problem_, x, policy, 0, 5);
  policy.set(iteration_->solution());
  const auto second = iteration_->solve(problem_, x, policy, 0.01, 1);
  EXPECT_EQ(allocationCount(), before);
  EXPECT_TRUE(first.ok());
  EXPECT_TRUE(second.ok());
}

}  // namespace
}  // namespace ballbot
