#include "estimator/information_update.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "estimator/partial_ldlt.hpp"

namespace ballbot {
namespace {

constexpr int kNew = kTangentDim;  // first column of the new state
constexpr int kRhsRow = 2 * kTangentDim;
using System = Eigen::Matrix<double, kRhsRow + 4, kRhsRow + 4>;

/// Adds rows [kRow, kRow + kRows), which touch the old state's columns [kOld, kOld + kOldCount)
/// and the new state's [kNewFrom, kNewFrom + kNewCount), to the normal equations.
template <int kRow, int kRows, int kOld, int kOldCount, int kNewFrom, int kNewCount>
void addRows(const Residuals& r, System& S) noexcept {
  const auto A = r.d_old.block<kRows, kOldCount>(kRow, kOld);
  const auto B = r.d_new.block<kRows, kNewCount>(kRow, kNewFrom);
  const auto y = r.y.segment<kRows>(kRow);
  S.block<kOldCount, kOldCount>(kOld, kOld) += A.transpose().lazyProduct(A);
  S.block<kNewCount, kOldCount>(kNew + kNewFrom, kOld) += B.transpose().lazyProduct(A);
  S.block<kNewCount, kNewCount>(kNew + kNewFrom, kNew + kNewFrom) += B.transpose().lazyProduct(B);
  S.block<1, kOldCount>(kRhsRow, kOld) += y.transpose().lazyProduct(A);
  S.block<1, kNewCount>(kRhsRow, kNew + kNewFrom) += y.transpose().lazyProduct(B);
  S(kRhsRow, kRhsRow) += y.squaredNorm();
}

/// Adds one row with few entries: value y, and (column, coefficient) with columns ascending, old
/// state first.
template <std::size_t kCount>
void addSparseRow(double y, const std::array<int, kCount>& column,
                  const std::array<double, kCount>& coefficient, System& S) noexcept {
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t j = i; j < kCount; ++j) {
      S(column[j], column[i]) += coefficient[j] * coefficient[i];
    }
    S(kRhsRow, column[i]) += y * coefficient[i];
  }
  S(kRhsRow, kRhsRow) += y * y;
}

/// Rows whose blocks are diagonal: position, gyroscope and the two biases.
void addDiagonalRows(const Residuals& r, System& S) noexcept {
  for (int i = 0; i < 2; ++i) {
    const int row = kRowPosition + i, p = kTanPosition + i, v = kTanVelocity + i;
    addSparseRow<4>(r.y[row], {p, v, kNew + p, kNew + v},
                    {r.d_old(row, p), r.d_old(row, v), r.d_new(row, p), r.d_new(row, v)}, S);
  }
  for (int i = 0; i < 3; ++i) {
    const int gyro = kRowGyro + i, w = kTanOmega + i, bg = kTanGyroBias + i;
    addSparseRow<3>(r.y[gyro], {w, kNew + w, kNew + bg},
                    {r.d_old(gyro, w), r.d_new(gyro, w), r.d_new(gyro, bg)}, S);
    const int walk_g = kRowGyroBias + i;
    addSparseRow<2>(r.y[walk_g], {bg, kNew + bg}, {r.d_old(walk_g, bg), r.d_new(walk_g, bg)}, S);
    const int walk_a = kRowAccelBias + i, ba = kTanAccelBias + i;
    addSparseRow<2>(r.y[walk_a], {ba, kNew + ba}, {r.d_old(walk_a, ba), r.d_new(walk_a, ba)}, S);
  }
}

template <int kRow>
void addWheel(const Residuals& r, System& S) noexcept {
  addRows<kRow, 1, kTanAttitude, 5, kTanAttitude, 8>(r, S);
}

}  // namespace

bool InformationUpdate::solve(const TangentMatrix& information, const Residuals& r,
                              const std::array<bool, kWheelCount>& use_wheel) noexcept {
  System& S = system_;
  S.setZero();
  S.topLeftCorner<kTangentDim, kTangentDim>() = information;
  addDiagonalRows(r, S);
  addRows<kRowAttitude, 3, kTanAttitude, 3, kTanAttitude, 8>(r, S);
  addRows<kRowAccel, 3, kTanAttitude, 8, kTanAttitude, 11>(r, S);
  if (use_wheel[0]) addWheel<kRowWheels>(r, S);
  if (use_wheel[1]) addWheel<kRowWheels + 1>(r, S);
  if (use_wheel[2]) addWheel<kRowWheels + 2>(r, S);
  use_wheel_ = use_wheel;

  // Rows M of the wheels ride along: below the elimination they become y - M H^-1 g and -M H^-1 M'.
  S.block<3, kTangentDim>(kRhsRow + 1, 0) = r.d_old.middleRows<3>(kRowWheels);
  S.block<3, kTangentDim>(kRhsRow + 1, kNew) = r.d_new.middleRows<3>(kRowWheels);
  S.block<3, 1>(kRhsRow + 1, kRhsRow) = r.y.segment<3>(kRowWheels);

  if (!eliminate<0, kNew>(S, inverse_pivot_)) return false;
  information_ = S.block<kTangentDim, kTangentDim>(kNew, kNew).selfadjointView<Eigen::Lower>();
  if (!eliminate<kNew, kRhsRow>(S, inverse_pivot_)) return false;
  // L' d = -(L D)^-1 g, whose right-hand side stands in the last row. Entries of d that are still
  // zero blot out what a column holds above its diagonal.
  delta_.setZero();
  for (int j = kTangentDim - 1; j >= 0; --j) {
    const double rest = S.block<kTangentDim, 1>(kNew, kNew + j).dot(delta_);
    delta_[j] = -(S(kRhsRow, kNew + j) + rest) * inverse_pivot_[kNew + j];
  }
  return delta_.allFinite();
}

double InformationUpdate::standardizedWheel(int i) const noexcept {
  const int row = kRhs + 1 + i;
  const double predicted = -system_(row, row);  // variance of M d at the minimum
  const double variance = use_wheel_[static_cast<std::size_t>(i)] ? 1 - predicted : 1 + predicted;
  return variance > 1e-6 ? system_(row, kRhs) / std::sqrt(variance) : 0.0;
}

TangentMatrix InformationUpdate::covarianceRoot() const noexcept {
  // Column k of L'^-1, from the columns before it; then columns by the roots of the pivots.
  TangentMatrix root = TangentMatrix::Identity();
  for (int k = 1; k < kTangentDim; ++k) {
    for (int j = 0; j < k; ++j) {
      root.col(k) -= system_(kNew + k, kNew + j) * inverse_pivot_[kNew + j] * root.col(j);
    }
  }
  for (int k = 0; k < kTangentDim; ++k) root.col(k) *= std::sqrt(inverse_pivot_[kNew + k]);
  return root;
}

TangentMatrix inverseRoot(const TangentMatrix& spd) noexcept {
  const Eigen::LLT<TangentMatrix> llt(spd);
  if (llt.info() != Eigen::Success) return TangentMatrix::Zero();
  return llt.matrixU().solve(TangentMatrix::Identity());
}

TangentMatrix inverseSpd(const TangentMatrix& spd) noexcept {
  const TangentMatrix root = inverseRoot(spd);
  return root * root.transpose();
}

}  // namespace ballbot
