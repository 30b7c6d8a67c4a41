#pragma once

#include <type_traits>

#include <Eigen/Core>

namespace ballbot {

/// How Eigen is told of an R x C matrix whose element (i, j) lies at i * kRowStride + j *
/// kColumnStride of an array of doubles. One stride must be 1 unless R or C is. Eigen takes only
/// rows that are row-major and columns that are column-major; their one stride is the inner one.
template <int R, int C, int kRowStride, int kColumnStride>
struct StridedLayout {
  static constexpr bool kColumn = C == 1, kRow = R == 1 && C > 1;
  static_assert(kColumn || kRow || kRowStride == 1 || kColumnStride == 1);
  static constexpr int kOrder =
      kRow || (!kColumn && kRowStride != 1) ? Eigen::RowMajor : Eigen::ColMajor;
  static constexpr int kStride = kColumn || (!kRow && kRowStride != 1) ? kRowStride : kColumnStride;

  using Matrix = Eigen::Matrix<double, R, C, kOrder>;
  using Stride =
      std::conditional_t<kColumn || kRow, Eigen::InnerStride<kStride>, Eigen::OuterStride<kStride>>;
};

template <int R, int C, int kRowStride, int kColumnStride>
using StridedView = Eigen::Map<typename StridedLayout<R, C, kRowStride, kColumnStride>::Matrix, 0,
                               typename StridedLayout<R, C, kRowStride, kColumnStride>::Stride>;
template <int R, int C, int kRowStride, int kColumnStride>
using ConstStridedView =
    Eigen::Map<const typename StridedLayout<R, C, kRowStride, kColumnStride>::Matrix, 0,
               typename StridedLayout<R, C, kRowStride, kColumnStride>::Stride>;

}  // namespace ballbot
