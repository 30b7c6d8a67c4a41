#include <cmath>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "core/error.hpp"
#include "solver/riccati_equation_impl.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

using Matrix2 = Eigen::Matrix2d;
constexpr int kLarge = 16;
using LargeMatrix = Eigen::Matrix<double, kLarge, kLarge>;

/// The same solution from the stable invariant subspace of the Hamiltonian matrix.
template <int N>
Eigen::Matrix<double, N, N> fromHamiltonian(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, N>& G,
                                            const Eigen::Matrix<double, N, N>& Q) {
  Eigen::Matrix<double, 2 * N, 2 * N> H;
  H << A, -G, -Q, -A.transpose();
  const Eigen::MatrixXcd stable = stableEigenvectorsOf(H);
  EXPECT_EQ(stable.cols(), N);
  return (stable.bottomRows(N) * Eigen::MatrixXcd(stable.topRows(N)).inverse()).real();
}

TEST(RiccatiEquation, MatchesTheDoubleIntegratorInClosedForm) {
  const double q1 = 4, q2 = 0.5;
  const Matrix2 A = (Matrix2() << 0, 1, 0, 0).finished();
  const Matrix2 G = (Matrix2() << 0, 0, 0, 1).finished();
  const Matrix2 Q = Eigen::Vector2d(q1, q2).asDiagonal();
  const double x12 = std::sqrt(q1), x22 = std::sqrt(q2 + 2 * x12);
  const Matrix2 expected = (Matrix2() << x12 * x22, x12, x12, x22).finished();
  EXPECT_LT((solveContinuousRiccati<2>(A, G, Q) - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(RiccatiEquation, AgreesWithTheHamiltoniansStableSubspaceOnAStiffUnstableSystem) {
  std::srand(7);
  LargeMatrix A = LargeMatrix::Random();
  A.diagonal().head<4>().setConstant(6);     // unstable
  A.diagonal().tail<4>().setConstant(-300);  // fast
  Eigen::Matrix<double, kLarge, 5> B = decltype(B)::Random();
  const LargeMatrix G = B * B.transpose();
  const LargeMatrix Q = Eigen::Matrix<double, kLarge, 1>::LinSpaced(0.1, 40).asDiagonal();
  const LargeMatrix X = solveContinuousRiccati<kLarge>(A, G, Q);
  const LargeMatrix reference = fromHamiltonian<kLarge>(A, G, Q);
  EXPECT_LT((X - reference).cwiseAbs().maxCoeff(), 1e-8 * reference.cwiseAbs().maxCoeff());
  EXPECT_LT(continuousRiccatiResidual<kLarge>(A, G, Q, X), 1e-12);
}

TEST(RiccatiEquation, RefusesAnUnstableModeThatNoInputReaches) {
  const Matrix2 A = (Matrix2() << 1, 0, 0, -1).finished();
  const Matrix2 G = (Matrix2() << 0, 0, 0, 1).finished();
  try {
    solveContinuousRiccati<2>(A, G, Matrix2::Identity());
    FAIL() << "no error";
  } catch (const NumericalError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("the inputs must reach every unstable mode"));
  }
}

TEST(RiccatiEquation, RefusesAnUnstableModeThatTheWeightsDoNotSee) {
  const Matrix2 A = (Matrix2() << 1, 0, 0, -1).finished();
  const Matrix2 Q = (Matrix2() << 0, 0, 0, 1).finished();
  EXPECT_THROW(solveContinuousRiccati<2>(A, Matrix2::Identity(), Q), NumericalError);
}

}  // namespace
}  // namespace ballbot
