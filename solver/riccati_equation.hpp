#pragma once

#include <Eigen/Core>

namespace ballbot {

/// The stabilising solution X = X^T >= 0 of the continuous algebraic Riccati equation
///
///   A^T X + X A - X G X + Q = 0,   G = B R^-1 B^T.
///
/// Structure-preserving doubling after a Cayley transform (Chu, Fan, Lin, Wang, "A structure-
/// preserving doubling algorithm for continuous-time algebraic Riccati equations", 2005): about a
/// dozen steps of one LU factorisation each, quadratic convergence.
/// @throw NumericalError if (A, B) cannot be stabilised, Q does not see an unstable mode, or the
///        residual stays above 1e-9 of the size of the equation's terms.
template <int N>
Eigen::Matrix<double, N, N> solveContinuousRiccati(const Eigen::Matrix<double, N, N>& A,
                                                   const Eigen::Matrix<double, N, N>& G,
                                                   const Eigen::Matrix<double, N, N>& Q);

/// Largest element of |A^T X + X A - X G X + Q| relative to the largest of its terms.
template <int N>
double continuousRiccatiResidual(const Eigen::Matrix<double, N, N>& A,
                                 const Eigen::Matrix<double, N, N>& G,
                                 const Eigen::Matrix<double, N, N>& Q,
                                 const Eigen::Matrix<double, N, N>& X);

}  // namespace ballbot
