#pragma once

#include <Eigen/Core>

namespace ballbot {

/// Eliminates columns [kFrom, kTo) of the symmetric matrix whose lower half S holds: S = L D L'. On
/// return an eliminated column holds that of L times its pivot, `inverse_pivot` one over it, and
/// the rest of the lower half is the Schur complement, which is where the next call goes on.
/// Entries above the diagonal are used as scratch.
///
/// Four columns at a time and onto two columns at once, so that every entry behind them is loaded
/// once per four pivots; kDim, kFrom and kTo are multiples of four. Returns false where a pivot is
/// not positive, and then S is of no use. Free of allocation; for the control step.
template <int kFrom, int kTo, int kDim>
[[nodiscard]] bool eliminate(Eigen::Matrix<double, kDim, kDim>& S,
                             Eigen::Matrix<double, kDim, 1>& inverse_pivot) noexcept {
  static_assert(kDim % 4 == 0 && kFrom % 4 == 0 && kTo % 4 == 0, "panels of four");
  using Pack = Eigen::Array<double, 4, 1>;
  using PackMap = Eigen::Map<Pack, Eigen::AlignedMax>;
  double* const data = S.data();
  const auto pack = [data](int row, int column) { return PackMap(data + column * kDim + row); };

  for (int panel = kFrom; panel < kTo; panel += 4) {
    for (int j = panel; j < panel + 4; ++j) {
      if (!(S(j, j) > 0)) return false;  // NaN too
      inverse_pivot[j] = 1 / S(j, j);
      for (int k = j + 1; k < panel + 4; ++k) {
        const double f = S(k, j) * inverse_pivot[j];
        for (int row = panel; row < kDim; row += 4) pack(row, k) -= f * pack(row, j);
      }
    }
    for (int c = panel + 4; c < kDim; c += 2) {
      Eigen::Matrix<double, 4, 2> f;  // entries of L
      for (int j = 0; j < 4; ++j) {
        f(j, 0) = S(c, panel + j) * inverse_pivot[panel + j];
        f(j, 1) = S(c + 1, panel + j) * inverse_pivot[panel + j];
      }
      for (int row = c / 4 * 4; row < kDim; row += 4) {
        const Pack p0 = pack(row, panel), p1 = pack(row, panel + 1);
        const Pack p2 = pack(row, panel + 2), p3 = pack(row, panel + 3);
        pack(row, c) -= f(0, 0) * p0 + f(1, 0) * p1 + f(2, 0) * p2 + f(3, 0) * p3;
        pack(row, c + 1) -= f(0, 1) * p0 + f(1, 1) * p1 + f(2, 1) * p2 + f(3, 1) * p3;
      }
    }
  }
  return true;
}

}  // namespace ballbot
