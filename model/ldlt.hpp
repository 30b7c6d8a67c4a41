#pragma once

#include <Eigen/Core>

namespace ballbot {

/// Factors L D L^T of a symmetric positive definite matrix of small size, for scalars that may
/// carry several lanes: no branch depends on a value. Where the matrix is not positive definite or
/// not finite, solutions are not finite or meaningless; nobody is told.
template <typename Scalar, int N>
class Ldlt {
 public:
  explicit Ldlt(const Eigen::Matrix<Scalar, N, N>& M) : L_(M) {
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k) {
      inverse_d_[k] = Scalar(1) / L_(k, k);
#pragma GCC unroll 8
      for (int i = k + 1; i < N; ++i) {
        const Scalar l = L_(i, k) * inverse_d_[k];
#pragma GCC unroll 8
        for (int j = k + 1; j <= i; ++j) L_(i, j) -= l * L_(j, k);
      }
#pragma GCC unroll 8
      for (int i = k + 1; i < N; ++i) L_(i, k) *= inverse_d_[k];
    }
  }

  /// x := M^-1 x.
  template <typename Vector>
  void solveInPlace(Vector&& x) const {
    Scalar y[N];
#pragma GCC unroll 8
    for (int i = 0; i < N; ++i) {
      y[i] = x[i];
#pragma GCC unroll 8
      for (int k = 0; k < i; ++k) y[i] -= L_(i, k) * y[k];
    }
#pragma GCC unroll 8
    for (int i = N - 1; i >= 0; --i) {
      y[i] *= inverse_d_[i];
#pragma GCC unroll 8
      for (int k = i + 1; k < N; ++k) y[i] -= L_(k, i) * y[k];
      x[i] = y[i];
    }
  }

 private:
  Eigen::Matrix<Scalar, N, N> L_;  ///< below the diagonal
  Scalar inverse_d_[N];
};

}  // namespace ballbot
