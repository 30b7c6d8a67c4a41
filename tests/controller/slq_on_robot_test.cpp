#include <cmath>

#include <gtest/gtest.h>

#include "controller/lqr.hpp"
#include "controller/mpc_policy.hpp"
#include "controller/whole_body_problem.hpp"
#include "solver/slq_solver.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot {
namespace {

/// Whole-body problem with the ball's place as the task, and its LQR policy as the nominal.
class SlqOnRobot : public testing::Test {
 protected:
  using Problem = WholeBodyProblem<6>;
  using Solver = SlqSolver<kMpcStateDim, 6, CostTerms>;
  static constexpr int kStages = 40;

  SlqOnRobot() {
    for (int k = 0; k <= kStages; ++k) {
      Tasks& t = problem_.tasks(k);
      TaskSchedule(robot_).at(0, 0, t);
      t.ball_position_weight.setConstant(100);
      t.ball_velocity_weight.setConstant(10);
      t.ee_position_weight << 50, 50, 0;
      t.ee_orientation_weight.setConstant(20);
      t.yaw_weight = 20;
      t.base_rate_weight.setConstant(4);
      t.arm_rate_weight.setConstant(1);
      t.wheel_torque_weight = 2;
      t.arm_torque_weight = 0.05;
    }
  }
  std::vector<double> knots() const {
    std::vector<double> out;
    for (int k = 0; k <= kStages; ++k) out.push_back(0.02 * k);
    return out;
  }
  void seed(Solver& solver) const {
    solver.setShift(1e-6);
    for (int k = 0; k < kStages; ++k) {
      solver.nominal().x[k] << lqr_.equilibrium.x, Vector3::Zero();
      solver.nominal().u[k] = lqr_.equilibrium.tau;
      solver.nominal().gain[k].K().setZero();
      solver.nominal().gain[k].K().leftCols<kStateDim>() = lqr_.K;
    }
  }
  MpcState start(int index) const {
    const RandomStream stream(11, "slq_solver_test");
    MpcState x;
    x << lqr_.equilibrium.x, Vector3::Zero();
    for (int i = 0; i < kMpcStateDim; ++i) {
      const double u = 2 * stream.uniforms(index, i / 4)[i % 4] - 1;
      const bool velocity = i >= kPositionDim && i < kStateDim;
      x[i] += u * (i < 3 ? 0.5 : i < 5 ? 0.1 : i < kPositionDim ? 0.4 : velocity ? 0.5 : 2.0);
    }
    return x;
  }

  RobotParameters robot_ = exampleRobot();
  LqrSolution lqr_ = designLqr(ReducedDynamics(robot_), robot_.nominal_arm, LqrWeights{});
  Problem problem_{robot_, Constraints(robot_), FrequencyShaping{16, 157}, TerminalCost{}, knots()};
};

TEST_F(SlqOnRobot, TheCostFallsMonotonicallyFromFiftyRandomStarts) {
  Solver solver(kStages, SlqOptions{});
  for (int i = 0; i < 50; ++i) {
    seed(solver);
    std::vector<double> costs;
    const SlqReport<CostTerms> report = solver.converge(problem_, start(i), 400, 1e-9, &costs);
    EXPECT_EQ(report.status, SlqStatus::kConverged)
        << "start " << i << ": " << slqStatusName(report.status);
    EXPECT_LT(costs.back(), report.terms.total() + 1e-9);
    for (std::size_t k = 1; k < costs.size(); ++k) {
      EXPECT_LE(costs[k], costs[k - 1] + 1e-9 * std::abs(costs[k - 1]))
          << "start " << i << ", " << k;
    }
  }
}

TEST_F(SlqOnRobot, ThePolicyRolledOutAgainCostsWhatTheReportSays) {
  Solver solver(kStages, SlqOptions{});
  seed(solver);
  const auto x0 = start(3);
  const SlqReport<CostTerms> report = solver.iterate(problem_, x0);
  ASSERT_EQ(report.status, SlqStatus::kImproved);
  CostTerms terms;
  MpcState x = x0, next;
  for (int k = 0; k < kStages; ++k) {
    const auto& s = solver.solution();
    const Eigen::Matrix<double, 6, 1> u = s.u[k] + s.gain[k].K() * (x - s.x[k]);
    problem_.addCost(k, x, u, terms);
    problem_.step(k, x, u, next);
    x = next;
  }
  problem_.addFinalCost(x, terms);
  EXPECT_NEAR(terms.total(), report.cost, 1e-12 * (1 + std::abs(report.cost)));
}

TEST_F(SlqOnRobot, TwoThreadsGiveTheBitsOfOne) {
  SlqOptions two;
  two.threads = 2;
  Solver one_thread(kStages, SlqOptions{}), two_threads(kStages, two);
  for (int i = 0; i < 20; ++i) {
    for (Solver* solver : {&one_thread, &two_threads}) {
      seed(*solver);
      ASSERT_TRUE(solver->converge(problem_, start(i), 3, 1e-9).ok());
    }
    for (int k = 0; k < kStages; ++k) {
      ASSERT_EQ(one_thread.solution().x[k + 1], two_threads.solution().x[k + 1]);
      ASSERT_EQ(one_thread.solution().u[k], two_threads.solution().u[k]);
      ASSERT_EQ(one_thread.solution().gain[k].K(), two_threads.solution().gain[k].K());
    }
  }
}

TEST_F(SlqOnRobot, ASolveDoesNotAllocate) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  Solver solver(kStages, SlqOptions{});
  seed(solver);
  const auto x0 = start(1);
  const auto before = allocationCount();
  const SlqReport<CostTerms> report = solver.converge(problem_, x0, 10, 1e-9);
  EXPECT_EQ(allocationCount(), before);
  EXPECT_TRUE(report.ok());
}

TEST_F(SlqOnRobot, ShapingWithAUnityFilterEqualsNoShaping) {
  // A filter whose zero is its pole passes torques unchanged, wherever that is and whatever the
  // filter's state: the plan must not depend on either.
  Problem slow(robot_, Constraints(robot_), FrequencyShaping{20, 20}, TerminalCost{}, knots());
  Problem fast(robot_, Constraints(robot_), FrequencyShaping{500, 500}, TerminalCost{}, knots());
  for (int k = 0; k <= kStages; ++k) slow.tasks(k) = fast.tasks(k) = problem_.tasks(k);
  Solver a(kStages, SlqOptions{}), b(kStages, SlqOptions{});
  seed(a);
  seed(b);
  auto x0 = start(2);
  ASSERT_TRUE(a.iterate(slow, x0).ok());
  x0.tail<3>().setConstant(-3);
  ASSERT_TRUE(b.iterate(fast, x0).ok());
  for (int k = 0; k < kStages; ++k) {
    EXPECT_LT((a.solution().u[k] - b.solution().u[k]).norm(), 1e-10);
    EXPECT_LT(a.solution().gain[k].K().rightCols<3>().norm(), 1e-10);
  }
}

}  // namespace
}  // namespace ballbot
