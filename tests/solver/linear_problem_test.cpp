#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "solver/slq_solver_impl.hpp"
#include "tests/solver/support/linear_quadratic_problem.hpp"

namespace ballbot {
namespace {

/// Textbook recursion in dynamic matrices; gains and steps from the first stage to the last, and
/// the value of the whole horizon, 1/2 x^T S x + s^T x + c.
template <int NX, int NU>
struct Textbook {
  explicit Textbook(const LinearQuadraticProblem<NX, NU>& p) {
    const Eigen::MatrixXd A = p.A, B = p.B, R = p.R, P = p.Pt.transpose(), Q = p.Q;
    S = p.Qf;
    s = Eigen::VectorXd::Zero(NX);
    for (int k = 0; k < p.stages(); ++k) {
      const Eigen::MatrixXd H_inverse = (R + B.transpose() * S * B).inverse();
      const Eigen::MatrixXd G = P + B.transpose() * S * A;
      const Eigen::VectorXd g = p.r + B.transpose() * s;
      K.insert(K.begin(), -H_inverse * G);
      step.insert(step.begin(), -H_inverse * g);
      c -= 0.5 * g.dot(H_inverse * g);
      s = (p.q + A.transpose() * s - G.transpose() * H_inverse * g).eval();
      S = (Q + A.transpose() * S * A - G.transpose() * H_inverse * G).eval();
      S = (0.5 * (S + S.transpose())).eval();  // or asymmetry grows as the open loop does
    }
  }
  double value(const Eigen::VectorXd& x) const { return 0.5 * x.dot(S * x) + s.dot(x) + c; }

  std::vector<Eigen::MatrixXd> K;
  std::vector<Eigen::VectorXd> step;
  Eigen::MatrixXd S;
  Eigen::VectorXd s;
  double c = 0;
};

template <int X, int U>
struct Sizes {
  static constexpr int NX = X, NU = U;
};

template <typename Sizes>
class LinearProblem : public testing::Test {
 protected:
  static constexpr int kNX = Sizes::NX, kNU = Sizes::NU;
  using Solver = SlqSolver<kNX, kNU, ScalarCost>;
  using X = Eigen::Matrix<double, kNX, 1>;

  static void startFromZero(Solver& solver) {
    for (auto& x : solver.nominal().x) x.setZero();
    for (auto& u : solver.nominal().u) u.setZero();
  }
};

// Vectors and scalars among them, which Eigen lays out otherwise than matrices.
using AllSizes = testing::Types<Sizes<1, 1>, Sizes<1, 3>, Sizes<4, 1>, Sizes<7, 8>>;
TYPED_TEST_SUITE(LinearProblem, AllSizes);

TYPED_TEST(LinearProblem, OneIterationGivesTheTextbooksGainsInputsAndCost) {
  constexpr int NX = TestFixture::kNX, NU = TestFixture::kNU, kStages = 30;
  const LinearQuadraticProblem<NX, NU> problem(kStages, 5);
  SlqOptions options;
  options.base_shift = 0;
  typename TestFixture::Solver solver(kStages, options);
  this->startFromZero(solver);
  const typename TestFixture::X x0 = TestFixture::X::LinSpaced(-1, 2);
  const auto report = solver.iterate(problem, x0);
  ASSERT_EQ(report.status, SlqStatus::kImproved);
  EXPECT_EQ(report.step_length, 1);
  EXPECT_NEAR(report.nominal_cost - report.cost, report.predicted_decrease,
              1e-10 * std::abs(report.nominal_cost));

  const Textbook<NX, NU> textbook(problem);
  EXPECT_NEAR(report.cost, textbook.value(x0), 1e-10 * (1 + std::abs(report.cost)));
  Eigen::VectorXd x = x0;
  for (int k = 0; k < kStages; ++k) {
    const Eigen::VectorXd u = textbook.step[k] + textbook.K[k] * x;
    const double scale = 1 + textbook.K[k].cwiseAbs().maxCoeff();
    ASSERT_LT((solver.solution().gain[k].K() - textbook.K[k]).cwiseAbs().maxCoeff(), 1e-10 * scale);
    ASSERT_LT((solver.solution().u[k] - u).cwiseAbs().maxCoeff(), 1e-10 * (1 + u.norm()));
    x = problem.A * x + problem.B * u;
  }
}

TYPED_TEST(LinearProblem, ALongHorizonGivesTheAlgebraicGain) {
  constexpr int NX = TestFixture::kNX, NU = TestFixture::kNU, kStages = 400;
  LinearQuadraticProblem<NX, NU> problem(kStages, 8);
  problem.q.setZero();
  problem.r.setZero();
  problem.Pt.setZero();
  typename TestFixture::Solver solver(kStages, SlqOptions{});
  this->startFromZero(solver);
  ASSERT_TRUE(solver.iterate(problem, TestFixture::X::Ones()).ok());

  // The algebraic equation by doubling, which takes no single step of the recursion.
  using Matrix = Eigen::MatrixXd;
  const Matrix B = problem.B, R = problem.R;
  Matrix A = problem.A, S = problem.Q, G = B * R.inverse() * B.transpose();
  for (int i = 0; i < 30; ++i) {
    const Matrix W = (Matrix::Identity(NX, NX) + G * S).inverse();
    const Matrix dS = A.transpose() * S * W * A;
    G = (G + A * W * G * A.transpose()).eval();
    A = (A * W * A).eval();
    S += dS;
  }
  const Matrix K = -(R + B.transpose() * S * B).inverse() * B.transpose() * S * problem.A;
  EXPECT_LT((solver.solution().gain[0].K() - K).cwiseAbs().maxCoeff(),
            1e-5 * K.cwiseAbs().maxCoeff());  // the solver's regularisation of 1e-6 stays in
}

}  // namespace
}  // namespace ballbot
