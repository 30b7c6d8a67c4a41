#pragma once

// Register-blocked products of small column-major matrices whose row counts are multiples of four.
// Four doubles fill one AVX2 register; on other machines the compiler splits them. The order of
// every sum is fixed by the source, so results do not depend on alignment or on the machine's
// width.

namespace ballbot {

using Vec4 __attribute__((vector_size(32), may_alias)) = double;

constexpr int roundUpTo4(int n) { return (n + 3) / 4 * 4; }

inline Vec4 load4(const double* p) { return *reinterpret_cast<const Vec4*>(p); }
inline void store4(double* p, Vec4 v) { *reinterpret_cast<Vec4*>(p) = v; }

/// A block of kRows4 x 4 rows and kColumns columns, held in registers while sums run over it.
/// kRows4 * kColumns should stay at or below 12 of the 16 registers.
template <int kRows4, int kColumns>
struct Tile {
  Vec4 sum[kColumns][kRows4];

  void load(const double* C, int ldc) {
    for (int j = 0; j < kColumns; ++j)
      for (int i = 0; i < kRows4; ++i) sum[j][i] = load4(C + j * ldc + 4 * i);
  }
  void setZero() {
    for (int j = 0; j < kColumns; ++j)
      for (int i = 0; i < kRows4; ++i) sum[j][i] = Vec4{0, 0, 0, 0};
  }
  void store(double* C, int ldc) const {
    for (int j = 0; j < kColumns; ++j)
      for (int i = 0; i < kRows4; ++i) store4(C + j * ldc + 4 * i, sum[j][i]);
  }

  /// += A B over `depth` columns of A (stride lda); B(k, j) lies at B[k * row_stride + j *
  /// column_stride].
  void addProduct(const double* A, int lda, const double* B, int row_stride, int column_stride,
                  int depth) {
    for (int k = 0; k < depth; ++k) {
      Vec4 a[kRows4];
      for (int i = 0; i < kRows4; ++i) a[i] = load4(A + k * lda + 4 * i);
      for (int j = 0; j < kColumns; ++j) {
        const double b = B[k * row_stride + j * column_stride];
        for (int i = 0; i < kRows4; ++i) sum[j][i] += a[i] * b;
      }
    }
  }
  void subtractProduct(const double* A, int lda, const double* B, int row_stride, int column_stride,
                       int depth) {
    for (int k = 0; k < depth; ++k) {
      Vec4 a[kRows4];
      for (int i = 0; i < kRows4; ++i) a[i] = load4(A + k * lda + 4 * i);
      for (int j = 0; j < kColumns; ++j) {
        const double b = B[k * row_stride + j * column_stride];
        for (int i = 0; i < kRows4; ++i) sum[j][i] -= a[i] * b;
      }
    }
  }
};

}  // namespace ballbot
