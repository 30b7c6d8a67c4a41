#pragma once

#include <array>
#include <cmath>

namespace ballbot {

template <int N>
using SmallMatrix = std::array<std::array<double, N>, N>;
template <int N>
using SmallVector = std::array<double, N>;

/// Solves A x = b for the leading n x n part of a symmetric positive definite A, of which the lower
/// triangle is read and overwritten; x replaces b. Plain loops in one order: a library may cut its
/// loops where memory happens to be aligned, and then the last bit differs between processes.
template <int N>
void solveCholesky(SmallMatrix<N>& A, SmallVector<N>& b, int n) {
  for (int j = 0; j < n; ++j) {
    double diagonal = A[j][j];
    for (int k = 0; k < j; ++k) diagonal -= A[j][k] * A[j][k];
    diagonal = std::sqrt(diagonal);
    A[j][j] = diagonal;
    for (int i = j + 1; i < n; ++i) {
      double sum = A[i][j];
      for (int k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
      A[i][j] = sum / diagonal;
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= A[i][k] * b[k];
    b[i] /= A[i][i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) b[i] -= A[k][i] * b[k];
    b[i] /= A[i][i];
  }
}

}  // namespace ballbot
