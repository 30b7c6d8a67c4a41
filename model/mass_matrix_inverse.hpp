#pragma once

#include <cstring>

#include <Eigen/Core>

namespace ballbot {

/// Inverse of a symmetric positive definite 8 x 8 matrix by Gauss-Jordan elimination, which needs
/// no pivoting for such a matrix. Columns are pairs of compiler vectors, so each elimination step
/// is 16 fused multiply-adds with AVX2; for this size that is faster than a Cholesky factorisation
/// with one solve, and derivatives need the inverse anyway.
inline Eigen::Matrix<double, 8, 8> inverseOfPositiveDefinite(
    const Eigen::Matrix<double, 8, 8>& matrix) noexcept {
  typedef double Half __attribute__((vector_size(32)));
  typedef long long Lane __attribute__((vector_size(32)));
  Half column[8][2];
  static_assert(sizeof column == sizeof matrix);
  std::memcpy(column, matrix.data(), sizeof column);
#pragma GCC unroll 8
  for (int k = 0; k < 8; ++k) {
    // Lane k is replaced by selection: writing it in memory would stall the next vector load.
    const Lane at_k = Lane{0, 1, 2, 3} == k % 4;
    const int hit = k / 4;
    const double scale = 1 / column[k][hit][k % 4];
    const Half scales = {scale, scale, scale, scale};
    Half pivot[2] = {-scales * column[k][0], -scales * column[k][1]};
    pivot[hit] = at_k ? scales : pivot[hit];
#pragma GCC unroll 8
    for (int j = 0; j < 8; ++j) {
      if (j == k) continue;
      const double head = column[j][hit][k % 4];
      const Half heads = {head, head, head, head};
      column[j][hit] = at_k ? Half{} : column[j][hit];
      column[j][0] += pivot[0] * heads;
      column[j][1] += pivot[1] * heads;
    }
    column[k][0] = pivot[0];
    column[k][1] = pivot[1];
  }
  Eigen::Matrix<double, 8, 8> inverse;
  std::memcpy(inverse.data(), column, sizeof column);
  return inverse;
}

}  // namespace ballbot
