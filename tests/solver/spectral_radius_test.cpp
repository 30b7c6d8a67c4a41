#include "solver/spectral_radius.hpp"

#include <cmath>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

double radiusOf(const Eigen::MatrixXd& A) {
  return spectralRadius([&](Eigen::VectorXd& z) { z = (A * z).eval(); },
                        static_cast<int>(A.rows()));
}

/// Some orthogonal matrix.
Eigen::MatrixXd turn(int n) {
  Eigen::MatrixXd A(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) A(i, j) = std::sin(1.0 + 7.1 * i + 3.7 * j * j);
  }
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
}

TEST(SpectralRadius, IsTheSizeOfAComplexPairAmongManyThatAreSmaller) {
  const int n = 150;
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) D(i, i) = 0.9 * std::exp(-0.1 * i);
  D.topLeftCorner<2, 2>() << 0.6, 0.8, -0.8, 0.6;  // on the unit circle
  D(2, 2) = -0.97;
  const Eigen::MatrixXd Q = turn(n);
  EXPECT_NEAR(radiusOf(Q * D * Q.transpose()), 1, 1e-7);
}

TEST(SpectralRadius, OfAMapThatIsNotNormalIsThatOfItsEigenvalues) {
  const int n = 40;
  Eigen::MatrixXd A = turn(n) * Eigen::MatrixXd::Identity(n, n).triangularView<Eigen::Upper>();
  for (int i = 0; i < n; ++i) A.row(i) *= std::exp(-0.2 * i);
  EXPECT_NEAR(radiusOf(A), eigenvaluesOf(A).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SpectralRadius, SeesThroughADelayLine) {
  // x+ = -0.5 x(50 steps ago): the 51 roots of z^51 = -0.5 have one size.
  const int n = 51;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  A.bottomLeftCorner(n - 1, n - 1).setIdentity();
  A(0, n - 1) = -0.5;
  EXPECT_NEAR(radiusOf(A), std::pow(0.5, 1.0 / n), 1e-9);
}

TEST(SpectralRadius, OfWhatVanishesAfterAFewStepsIsZero) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 3);
  A(1, 0) = A(2, 1) = 5;
  EXPECT_EQ(radiusOf(A), 0);
}

TEST(SpectralRadius, OfWhatIsNotFiniteIsRefused) {
  EXPECT_THROW(radiusOf(Eigen::MatrixXd::Constant(3, 3, std::nan(""))), NumericalError);
}

}  // namespace
}  // namespace ballbot
