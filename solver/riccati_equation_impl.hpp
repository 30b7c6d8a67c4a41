#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "solver/riccati_equation.hpp"

namespace ballbot {
namespace detail {

template <typename Matrix>
double largest(const Matrix& m) {
  return m.cwiseAbs().maxCoeff();
}

/// @throw NumericalError that says so
[[noreturn]] void noUsableSolution(double relative_residual);

}  // namespace detail

template <int N>
double continuousRiccatiResidual(const Eigen::Matrix<double, N, N>& A,
                                 const Eigen::Matrix<double, N, N>& G,
                                 const Eigen::Matrix<double, N, N>& Q,
                                 const Eigen::Matrix<double, N, N>& X) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using detail::largest;
  const Matrix XA = X * A;
  const Matrix XGX = X * G * X;
  const Matrix residual = XA.transpose() + XA - XGX + Q;
  return largest(residual) / std::max({largest(XA), largest(XGX), largest(Q), 1e-300});
}

template <int N>
Eigen::Matrix<double, N, N> solveContinuousRiccati(const Eigen::Matrix<double, N, N>& A,
                                                   const Eigen::Matrix<double, N, N>& G,
                                                   const Eigen::Matrix<double, N, N>& Q) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using detail::largest;
  constexpr int kMaxDoublings = 60;
  constexpr double kConverged = 1e-15, kStable = 1e-6, kResidualLimit = 1e-9;
  const Matrix identity = Matrix::Identity();

  // Cayley transform s -> (s + gamma) / (s - gamma): the open left half plane becomes the inside of
  // the unit circle. Any gamma > 0 that is no eigenvalue serves; the size of A is the right scale.
  const double gamma = std::max(1.0, A.norm() / std::sqrt(static_cast<double>(N)));
  const Eigen::PartialPivLU<Matrix> A_gamma(A - gamma * identity);
  const Matrix A_gamma_inverse = A_gamma.inverse();
  const Matrix W = (A - gamma * identity).transpose() + Q * A_gamma_inverse * G;
  const Matrix W_inverse = W.inverse();
  Matrix Ak = identity + 2.0 * gamma * W_inverse.transpose();
  Matrix Gk = 2.0 * gamma * A_gamma_inverse * G * W_inverse;
  Matrix X = 2.0 * gamma * W_inverse * Q * A_gamma_inverse;

  for (int k = 0; k < kMaxDoublings; ++k) {
    const Eigen::PartialPivLU<Matrix> I_plus_GX(identity + Gk * X);
    const Matrix V = I_plus_GX.solve(Ak);    // (1 + G X)^-1 A
    const Matrix GVt = I_plus_GX.solve(Gk);  // (1 + G X)^-1 G
    const Matrix step = Ak.transpose() * X * V;
    Gk += Ak * GVt * Ak.transpose();
    Gk = (0.5 * (Gk + Gk.transpose())).eval();
    X += step;
    X = (0.5 * (X + X.transpose())).eval();
    Ak = (Ak * V).eval();
    if (!X.allFinite() || largest(step) <= kConverged * largest(X)) break;
  }

  // A_k tends to a power of the transformed closed loop: it vanishes if and only if that is stable.
  const bool stabilising = X.allFinite() && largest(Ak) < kStable;
  const double residual = stabilising ? continuousRiccatiResidual<N>(A, G, Q, X)
                                      : std::numeric_limits<double>::infinity();
  if (!(residual < kResidualLimit)) detail::noUsableSolution(residual);
  return X;
}

}  // namespace ballbot
