#include "controller/whole_body_problem.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

constexpr int NU = 12;
using Problem = WholeBodyProblem<NU>;
using X = Problem::X;
using U = Problem::U;
using Stage = Problem::Stage;

/// Numbers on (-1, 1), repeatable.
class Draw {
 public:
  explicit Draw(int index) : index_(index) {}
  double operator()() {
    const double u = stream_.uniforms(index_, count_ / 4)[count_ % 4];
    ++count_;
    return 2 * u - 1;
  }
  template <int N>
  Eigen::Matrix<double, N, 1> vector(double scale) {
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) v[i] = scale * (*this)();
    return v;
  }

 private:
  RandomStream stream_{3, "whole_body_problem_test"};
  int index_, count_ = 0;
};

/// Every task on, errors of every kind.
Tasks randomTasks(Draw& draw) {
  Tasks t;
  const auto weights = [&](auto& w, double scale) {
    for (int i = 0; i < w.size(); ++i) w[i] = scale * (1.5 + draw());
  };
  weights(t.ee_position_weight, 100);
  weights(t.ee_orientation_weight, 20);
  weights(t.ee_velocity_weight, 4);
  weights(t.ee_rate_weight, 1);
  weights(t.ball_position_weight, 50);
  weights(t.ball_velocity_weight, 10);
  weights(t.base_rate_weight, 4);
  weights(t.arm_position_weight, 5);
  weights(t.arm_rate_weight, 0.5);
  weights(t.contact_force_weight, 1);
  weights(t.contact_moment_weight, 2);
  t.yaw_weight = 20;
  t.wheel_torque_weight = 2;
  t.arm_torque_weight = 0.1;
  t.p_WE = Vector3(0.2, 0.1, 0.9) + draw.vector<3>(0.2);
  t.R_WE = expSO3(draw.vector<3>(0.7));
  t.v_WE_W = draw.vector<3>(0.3);
  t.w_WE_W = draw.vector<3>(0.3);
  t.ball_position = draw.vector<2>(0.5);
  t.ball_velocity = draw.vector<2>(0.5);
  t.yaw = draw();
  t.arm_position = draw.vector<3>(1);
  t.contact_force_C = Vector3(0, 0, 8);
  t.contact_moment_C = draw.vector<3>(1);
  t.R_WC = contactFrame(Vector3(-0.8, 0.6, 0));
  return t;
}

class WholeBodyProblemTest : public testing::TestWithParam<int> {
 protected:
  WholeBodyProblemTest() {
    Draw draw(GetParam());
    for (int k = 0; k <= problem_.stages(); ++k) problem_.tasks(k) = randomTasks(draw);
    x_.setZero();
    x_.segment<2>(kBallX) = draw.vector<2>(0.5);
    x_[kYaw] = 3 * draw();
    x_.segment<2>(kPitch) = draw.vector<2>(0.2);
    x_.segment<3>(kArm1) = robot_.nominal_arm + draw.vector<3>(0.4);
    x_.segment<8>(kPositionDim) = draw.vector<8>(1.5);
    x_.tail<3>() = draw.vector<3>(2);
    u_.head<3>() = draw.vector<3>(3);
    u_.segment<3>(3) = draw.vector<3>(8);
    u_.segment<3>(kJointCount) = Vector3(0, 0, 6) + draw.vector<3>(2);
    u_.tail<3>() = draw.vector<3>(2);
  }
  /// Where barriers are relaxed.
  void beyondEveryLimit() {
    x_[kPitch] = 0.5;
    x_[kArm1 + 1] = -2.1;
    x_[kArm1 + 2] = 2.7;
    x_.segment<3>(kPositionDim + kArmRate1) << 6.4, -5.9, -7;
    u_.head<6>() << 4.2, -3.9, -5, 18.4, -17.9, -20;
    u_.segment<3>(kJointCount) << 5, -3, 4;
  }
  void expectGradientsToBeDifferences();

  RobotParameters robot_ = exampleRobot();
  Problem problem_{
      robot_, Constraints(robot_), FrequencyShaping{20, 300}, TerminalCost{}, {0, 0.02, 0.05}};
  X x_;
  U u_;
};

double cost(const Problem& problem, const X& x, const U& u) {
  CostTerms terms;
  problem.addCost(0, x, u, terms);
  return terms.total();
}
double finalCost(const Problem& problem, const X& x) {
  CostTerms terms;
  problem.addFinalCost(x, terms);
  return terms.total();
}

TEST_P(WholeBodyProblemTest, AAndBAreCentralDifferencesOfTheStep) {
  Stage lq;
  CostTerms terms;
  problem_.approximate(1, 1, &x_, &u_, &terms, &lq);
  // Fourth order, so that a wide step serves: its rounding error stays near 1e-10.
  const double h = 1e-4;
  for (int i = 0; i < kMpcStateDim + NU; ++i) {
    const bool state = i < kMpcStateDim;
    const auto stepped = [&](double by) {
      X x = x_, out;
      U u = u_;
      (state ? x[i] : u[i - kMpcStateDim]) += by;
      problem_.step(1, x, u, out);
      return out;
    };
    const X difference =
        (8 * (stepped(h) - stepped(-h)) - (stepped(2 * h) - stepped(-2 * h))) / (12 * h);
    const X column = state ? X(lq.A().col(i)) : X(lq.B().col(i - kMpcStateDim));
    EXPECT_LT((column - difference).cwiseAbs().maxCoeff(), 1e-8) << "column " << i;
  }
}

void WholeBodyProblemTest::expectGradientsToBeDifferences() {
  Stage lq;
  CostTerms terms, expected;
  problem_.approximate(0, 1, &x_, &u_, &terms, &lq);
  problem_.addCost(0, x_, u_, expected);
  for (int i = 0; i < kCostTermCount; ++i) {
    EXPECT_NEAR(terms.value[i], expected.value[i], 1e-13 * (1 + std::abs(expected.value[i])))
        << costTermName(CostTerm(i));
  }
  const double h = 1e-5;
  for (int i = 0; i < kMpcStateDim; ++i) {
    X a = x_, b = x_;
    a[i] += h;
    b[i] -= h;
    const double difference = (cost(problem_, a, u_) - cost(problem_, b, u_)) / (2 * h);
    EXPECT_NEAR(lq.q()[i], difference, 1e-7 * (1 + 0.1 * std::abs(difference))) << "state " << i;
  }
  for (int i = 0; i < NU; ++i) {
    U a = u_, b = u_;
    a[i] += h;
    b[i] -= h;
    const double difference = (cost(problem_, x_, a) - cost(problem_, x_, b)) / (2 * h);
    EXPECT_NEAR(lq.r()[i], difference, 1e-7 * (1 + 0.1 * std::abs(difference))) << "input " << i;
  }
}

TEST_P(WholeBodyProblemTest, CostGradientsAreCentralDifferences) {
  expectGradientsToBeDifferences();
}

TEST_P(WholeBodyProblemTest, CostGradientsAreCentralDifferencesBeyondEveryLimitToo) {
  beyondEveryLimit();
  CostTerms terms;
  problem_.addCost(0, x_, u_, terms);
  EXPECT_GT(terms.violation, 0);
  expectGradientsToBeDifferences();
}

TEST_P(WholeBodyProblemTest, FinalCostGradientIsACentralDifference) {
  ValueFunction<kMpcStateDim> value;
  CostTerms terms;
  problem_.approximateFinalCost(x_, terms, value);
  EXPECT_NEAR(terms.total(), finalCost(problem_, x_), 1e-12);
  const double h = 1e-5;
  for (int i = 0; i < kMpcStateDim; ++i) {
    X a = x_, b = x_;
    a[i] += h;
    b[i] -= h;
    EXPECT_NEAR(value.s()[i], (finalCost(problem_, a) - finalCost(problem_, b)) / (2 * h), 1e-5)
        << i;
  }
}

TEST_P(WholeBodyProblemTest, TheLqrAsFinalCostHasItsGradientToo) {
  TerminalCost terminal;
  terminal.kind = TerminalCost::Kind::kLqr;
  Problem problem(robot_, Constraints(robot_), FrequencyShaping{20, 300}, terminal, {0, 0.02});
  problem.tasks(1) = problem_.tasks(1);
  if (GetParam() % 2) problem.tasks(1).ball_position_weight.setZero();
  ValueFunction<kMpcStateDim> value;
  CostTerms terms;
  problem.approximateFinalCost(x_, terms, value);
  EXPECT_NEAR(terms.total(), finalCost(problem, x_), 1e-9 * terms.total());
  EXPECT_GT(terms.value[kTerminalCost], 0);
  const double h = 1e-5;
  for (int i = 0; i < kMpcStateDim; ++i) {
    X a = x_, b = x_;
    a[i] += h;
    b[i] -= h;
    EXPECT_NEAR(value.s()[i], (finalCost(problem, a) - finalCost(problem, b)) / (2 * h), 1e-4) << i;
  }
}

TEST_P(WholeBodyProblemTest, HessiansArePositiveSemidefinite) {
  Stage lq;
  CostTerms terms;
  problem_.approximate(0, 1, &x_, &u_, &terms, &lq);
  Eigen::Matrix<double, kMpcStateDim + NU, kMpcStateDim + NU> H;
  H.topLeftCorner<kMpcStateDim, kMpcStateDim>() = lq.Q();
  H.bottomRightCorner<NU, NU>() = lq.R();
  H.bottomLeftCorner<NU, kMpcStateDim>() = lq.Pt().transpose();
  const Eigen::VectorXd eigen = symmetricEigenvaluesOf(H);
  EXPECT_GT(eigen[0], -1e-9 * eigen.tail<1>()[0]);
}

TEST_P(WholeBodyProblemTest, WithoutContactTheForceMovesNothing) {
  problem_.tasks(0).contact_force_weight.setZero();
  U pushed = u_;
  pushed.tail<6>() *= 3;
  X a, b;
  problem_.step(0, x_, u_, a);
  problem_.step(0, x_, pushed, b);
  EXPECT_EQ(a, b);
  Stage lq;
  CostTerms terms;
  problem_.approximate(0, 1, &x_, &u_, &terms, &lq);
  EXPECT_EQ(lq.B().rightCols<6>().norm(), 0);
}

TEST_P(WholeBodyProblemTest, WithoutATaskTheMomentMovesNothing) {
  problem_.tasks(0).contact_moment_weight.setZero();
  U twisted = u_;
  twisted.tail<3>() *= 3;
  X a, b;
  problem_.step(0, x_, u_, a);
  problem_.step(0, x_, twisted, b);
  EXPECT_EQ(a, b);
}

TEST_P(WholeBodyProblemTest, ProblemsWithFewerInputsAreTheSameWhereThoseAreZero) {
  const std::vector<double> knots = {0, 0.02, 0.05};
  WholeBodyProblem<6> torques(robot_, Constraints(robot_), FrequencyShaping{20, 300}, {}, knots);
  WholeBodyProblem<9> forces(robot_, Constraints(robot_), FrequencyShaping{20, 300}, {}, knots);
  u_.tail<6>().setZero();
  Tasks& tasks = problem_.tasks(0);
  tasks.contact_force_weight.setZero();
  torques.tasks(0) = forces.tasks(0) = tasks;
  X a, b, c;
  problem_.step(0, x_, u_, a);
  forces.step(0, x_, u_.head<9>(), b);
  torques.step(0, x_, u_.head<6>(), c);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a, c);
  CostTerms of_12, of_9, of_6;
  problem_.addCost(0, x_, u_, of_12);
  forces.addCost(0, x_, u_.head<9>(), of_9);
  torques.addCost(0, x_, u_.head<6>(), of_6);
  EXPECT_EQ(of_12.total(), of_9.total());
  EXPECT_EQ(of_12.total(), of_6.total());
}

TEST_P(WholeBodyProblemTest, AStageGetsTheSameBitsAloneAndInCompany) {
  const X x[2] = {x_, X(x_ + 0.01 * X::Ones())};
  const U u[2] = {u_, U(0.9 * u_)};
  Stage together[2], alone;
  CostTerms terms_together[2], terms_alone;
  problem_.approximate(0, 2, x, u, terms_together, together);
  problem_.approximate(1, 1, &x[1], &u[1], &terms_alone, &alone);
  EXPECT_EQ(together[1].A(), alone.A());
  EXPECT_EQ(together[1].B(), alone.B());
  EXPECT_EQ(together[1].Q(), alone.Q());
  EXPECT_EQ(together[1].R(), alone.R());
  EXPECT_EQ(together[1].q(), alone.q());
  EXPECT_EQ(together[1].r(), alone.r());
  EXPECT_EQ(terms_together[1].value, terms_alone.value);
}

TEST_P(WholeBodyProblemTest, TheStepConvergesToTheDifferentialEquation) {
  // Against a tenth of the step with the same held input: the error falls by the square of the step
  // up to the Coriolis terms, which are first order and small.
  const auto errorOf = [&](double H) {
    const int fine = 64;
    const Problem coarse(robot_, Constraints(robot_), FrequencyShaping{20, 300}, {}, {0, H});
    const Problem small(robot_, Constraints(robot_), FrequencyShaping{20, 300}, {}, {0, H / fine});
    X once, x = x_, next;
    coarse.step(0, x_, u_, once);
    for (int i = 0; i < fine; ++i) {
      small.step(0, x, u_, next);
      x = next;
    }
    return (once - x).norm();
  };
  const double at_20ms = errorOf(0.02), at_10ms = errorOf(0.01);
  EXPECT_LT(at_10ms, 0.35 * at_20ms);
  EXPECT_LT(at_20ms, 0.1);
}

INSTANTIATE_TEST_SUITE_P(RandomStates, WholeBodyProblemTest, testing::Range(0, 12));

}  // namespace
}  // namespace ballbot
