#pragma once

#include <cmath>

#include <Eigen/Core>

namespace ballbot {

/// Eliminates columns [kFrom, kTo) of the symmetric matrix whose lower half S holds: on return they
/// carry the Cholesky factor, and the rest of the lower half is the Schur complement, which is
/// where the next call goes on. Columns may reach into the upper half; nobody reads that.
/// Four columns at a time, so that each entry behind them is loaded once per four pivots; kDim,
/// kFrom and kTo are multiples of four. Returns false where a pivot is not positive, and then S
/// is of no use. Free of allocation; for the control step.
template <int kFrom, int kTo, int kDim>
[[nodiscard]] bool eliminate(Eigen::Matrix<double, kDim, kDim>& S) noexcept {
  static_assert(kDim % 4 == 0 && kFrom % 4 == 0 && kTo % 4 == 0, "panels of four");
  using Pack = Eigen::Array<double, 4, 1>;
  using PackMap = Eigen::Map<Pack, Eigen::AlignedMax>;
  double* const data = S.data();
  const auto pack = [data](int row, int column) { return PackMap(data + column * kDim + row); };

  for (int panel = kFrom; panel < kTo; panel += 4) {
    for (int j = panel; j < panel + 4; ++j) {
      const double pivot = S(j, j);
      if (!(pivot > 0)) return false;  // NaN too
      const double scale = 1 / std::sqrt(pivot);
      for (int row = panel; row < kDim; row += 4) pack(row, j) *= scale;
      for (int k = j + 1; k < panel + 4; ++k) {
        const double f = S(k, j);
        for (int row = panel; row < kDim; row += 4) pack(row, k) -= f * pack(row, j);
      }
    }
    for (int column = panel + 4; column < kDim; ++column) {
      const double f0 = S(column, panel), f1 = S(column, panel + 1);
      const double f2 = S(column, panel + 2), f3 = S(column, panel + 3);
      for (int row = column / 4 * 4; row < kDim; row += 4) {
        pack(row, column) -= f0 * pack(row, panel) + f1 * pack(row, panel + 1) +
                             f2 * pack(row, panel + 2) + f3 * pack(row, panel + 3);
      }
    }
  }
  return true;
}

}  // namespace ballbot
