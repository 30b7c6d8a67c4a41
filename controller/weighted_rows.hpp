#pragma once

#include <algorithm>

#include "controller/whole_body_cost.hpp"
#include "solver/vector_kernels.hpp"

namespace ballbot {

/// As many coordinates as velocities, and that many registers full.
constexpr int kCoordinates = kPositionDim, kPadded = roundUpTo4(kCoordinates);

/// Rows of weighted residuals of the end-effector: six by coordinates, one row after the other.
struct alignas(32) WeightedRows {
  double row[6][kPadded];

  void set(const EndEffectorJacobian& J, const Eigen::Matrix<double, 6, 1>& root_weight) {
    for (int r = 0; r < 6; ++r) {
      for (int i = 0; i < kCoordinates; ++i) row[r][i] = root_weight[r] * J(r, i);
      for (int i = kCoordinates; i < kPadded; ++i) row[r][i] = 0;
    }
  }
};

/// Adds A^T B to the block of `out` at (row, column).
inline void addRowsProduct(const WeightedRows& A, const WeightedRows& B, StateExpansion& out,
                           int row, int column) {
  for (int j = 0; j < kPadded; j += 4) {
    double* C = out.W + (column + j) * out.stride + row;
    Tile<kPadded / 4, 4> tile;
    if constexpr (kPadded == kCoordinates) {
      tile.load(C, out.stride);
      tile.addProduct(A.row[0], kPadded, B.row[0] + j, kPadded, 1, 6);
      tile.store(C, out.stride);
    } else {  // blocks begin anywhere, and what stands beside them is another's
      alignas(32) double sum[4 * kPadded];
      tile.setZero();
      tile.addProduct(A.row[0], kPadded, B.row[0] + j, kPadded, 1, 6);
      tile.store(sum, kPadded);
      for (int k = 0; k < std::min(4, kCoordinates - j); ++k) {
        for (int i = 0; i < kCoordinates; ++i) C[k * out.stride + i] += sum[k * kPadded + i];
      }
    }
  }
}

/// Adds A^T e to the gradient from index `first` on.
inline void addRowsGradient(const WeightedRows& A, const Eigen::Matrix<double, 6, 1>& e,
                            StateExpansion& out, int first) {
  Tile<kPadded / 4, 1> sum;
  sum.setZero();
  sum.addProduct(A.row[0], kPadded, e.data(), 1, 0, 6);
  alignas(32) double g[kPadded];
  sum.store(g, kPadded);
  for (int i = 0; i < kCoordinates; ++i) out.g(first + i) += g[i];
}

}  // namespace ballbot
