#include "estimator/information_update.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "estimator/partial_ldlt.hpp"

namespace ballbot {

/// Adds rows [kRow, kRow + kRows), which touch the old state's columns [kOld, kOld + kOldCount)
/// and the new state's [kNewFrom, kNewFrom + kNewCount), to the normal equations.
template <int kDim>
template <int kRow, int kRows, int kOld, int kOldCount, int kNewFrom, int kNewCount>
void BasicInformationUpdate<kDim>::addRows(const Residuals& r) noexcept {
  System& S = system_;
  const auto A = r.d_old.block<kRows, kOldCount>(kRow, kOld);
  const auto B = r.d_new.block<kRows, kNewCount>(kRow, kNewFrom);
  const auto y = r.y.segment<kRows>(kRow);
  S.template block<kOldCount, kOldCount>(kOld, kOld) += A.transpose().lazyProduct(A);
  S.template block<kNewCount, kOldCount>(kNew + kNewFrom, kOld) += B.transpose().lazyProduct(A);
  S.template block<kNewCount, kNewCount>(kNew + kNewFrom, kNew + kNewFrom) +=
      B.transpose().lazyProduct(B);
  S.template block<1, kOldCount>(kRhs, kOld) += y.transpose().lazyProduct(A);
  S.template block<1, kNewCount>(kRhs, kNew + kNewFrom) += y.transpose().lazyProduct(B);
  S(kRhs, kRhs) += y.squaredNorm();
}

/// Adds one row with few entries: value y, and (column, coefficient) with columns ascending, old
/// state first.
template <int kDim>
template <std::size_t kCount>
void BasicInformationUpdate<kDim>::addSparseRow(
    double y, const std::array<int, kCount>& column,
    const std::array<double, kCount>& coefficient) noexcept {
  System& S = system_;
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t j = i; j < kCount; ++j) {
      S(column[j], column[i]) += coefficient[j] * coefficient[i];
    }
    S(kRhs, column[i]) += y * coefficient[i];
  }
  S(kRhs, kRhs) += y * y;
}

/// Rows whose blocks are diagonal: position, gyroscope, the two biases and the spin.
template <int kDim>
void BasicInformationUpdate<kDim>::addDiagonalRows(const Residuals& r) noexcept {
  for (int i = 0; i < 2; ++i) {
    const int row = kRowPosition + i, p = kTanPosition + i, v = kTanVelocity + i;
    addSparseRow<4>(r.y[row], {p, v, kNew + p, kNew + v},
                    {r.d_old(row, p), r.d_old(row, v), r.d_new(row, p), r.d_new(row, v)});
  }
  for (int i = 0; i < 3; ++i) {
    const int gyro = kRowGyro + i, w = kTanOmega + i, bg = kTanGyroBias + i;
    addSparseRow<3>(r.y[gyro], {w, kNew + w, kNew + bg},
                    {r.d_old(gyro, w), r.d_new(gyro, w), r.d_new(gyro, bg)});
    const int walk_g = kRowGyroBias + i;
    addSparseRow<2>(r.y[walk_g], {bg, kNew + bg}, {r.d_old(walk_g, bg), r.d_new(walk_g, bg)});
    const int walk_a = kRowAccelBias + i, ba = kTanAccelBias + i;
    addSparseRow<2>(r.y[walk_a], {ba, kNew + ba}, {r.d_old(walk_a, ba), r.d_new(walk_a, ba)});
  }
  if constexpr (kDim > kTanSpin) {
    addSparseRow<2>(r.y[kRowSpin], {kTanSpin, kNew + kTanSpin},
                    {r.d_old(kRowSpin, kTanSpin), r.d_new(kRowSpin, kTanSpin)});
  }
}

template <int kDim>
template <int kRow>
void BasicInformationUpdate<kDim>::addWheel(const Residuals& r) noexcept {
  addRows<kRow, 1, kTanAttitude, 5, kTanAttitude, 8>(r);
  if constexpr (kDim > kTanSpin) {
    System& S = system_;
    constexpr int kSpin = kNew + kTanSpin;
    const double c = r.d_new(kRow, kTanSpin);
    S.template block<1, 5>(kSpin, kTanAttitude) += c * r.d_old.block<1, 5>(kRow, kTanAttitude);
    S.template block<1, 8>(kSpin, kNew + kTanAttitude) +=
        c * r.d_new.block<1, 8>(kRow, kTanAttitude);
    S(kSpin, kSpin) += c * c;
    S(kRhs, kSpin) += r.y[kRow] * c;
  }
}

template <int kDim>
bool BasicInformationUpdate<kDim>::solve(const Matrix& information, const Residuals& r,
                                         const std::array<bool, kWheelCount>& use_wheel) noexcept {
  System& S = system_;
  S.setZero();
  S.template topLeftCorner<kDim, kDim>() = information;
  for (int unused = kDim; unused < kNew; ++unused) {
    S(unused, unused) = S(kNew + unused, kNew + unused) = 1;
  }
  addDiagonalRows(r);
  addRows<kRowAttitude, 3, kTanAttitude, 3, kTanAttitude, 8>(r);
  addRows<kRowAccel, 3, kTanAttitude, 8, kTanAttitude, 11>(r);
  if (use_wheel[0]) addWheel<kRowWheels>(r);
  if (use_wheel[1]) addWheel<kRowWheels + 1>(r);
  if (use_wheel[2]) addWheel<kRowWheels + 2>(r);
  use_wheel_ = use_wheel;

  // Rows M of the wheels ride along: below the elimination they become y - M H^-1 g and -M H^-1 M'.
  S.template block<3, kDim>(kRhs + 1, 0) = r.d_old.block<3, kDim>(kRowWheels, 0);
  S.template block<3, kDim>(kRhs + 1, kNew) = r.d_new.block<3, kDim>(kRowWheels, 0);
  S.template block<3, 1>(kRhs + 1, kRhs) = r.y.segment<3>(kRowWheels);

  if (!eliminate<0, kNew>(S, inverse_pivot_)) return false;
  information_ = S.template block<kDim, kDim>(kNew, kNew).template selfadjointView<Eigen::Lower>();
  if (!eliminate<kNew, kRhs>(S, inverse_pivot_)) return false;
  // L' d = -(L D)^-1 g, whose right-hand side stands in the last row. Entries of d that are still
  // zero blot out what a column holds above its diagonal.
  delta_.setZero();
  for (int j = kDim - 1; j >= 0; --j) {
    const double rest = S.template block<kDim, 1>(kNew, kNew + j).dot(delta_);
    delta_[j] = -(S(kRhs, kNew + j) + rest) * inverse_pivot_[kNew + j];
  }
  return delta_.allFinite();
}

template <int kDim>
double BasicInformationUpdate<kDim>::standardizedWheel(int i) const noexcept {
  const int row = kRhs + 1 + i;
  const double predicted = -system_(row, row);  // variance of M d at the minimum
  const double variance = use_wheel_[static_cast<std::size_t>(i)] ? 1 - predicted : 1 + predicted;
  return variance > 1e-6 ? system_(row, kRhs) / std::sqrt(variance) : 0.0;
}

template <int kDim>
double BasicInformationUpdate<kDim>::standardizedShift(const Vector3& shift) const noexcept {
  double value = 0, variance = 0;
  for (int i = 0; i < kWheelCount; ++i) {
    if (!use_wheel_[static_cast<std::size_t>(i)]) continue;
    value += shift[i] * system_(kRhs + 1 + i, kRhs);
    variance += shift[i] * shift[i];
    for (int j = 0; j < kWheelCount; ++j) {
      if (!use_wheel_[static_cast<std::size_t>(j)]) continue;
      variance +=
          shift[i] * shift[j] * system_(kRhs + 1 + std::max(i, j), kRhs + 1 + std::min(i, j));
    }
  }
  return variance > 1e-6 * shift.squaredNorm() ? value / std::sqrt(variance) : 0.0;
}

template <int kDim>
BasicTangentMatrix<kDim> BasicInformationUpdate<kDim>::covarianceRoot() const noexcept {
  // Column k of L'^-1, from the columns before it; then columns by the roots of the pivots.
  Matrix root = Matrix::Identity();
  for (int k = 1; k < kDim; ++k) {
    for (int j = 0; j < k; ++j) {
      root.col(k) -= system_(kNew + k, kNew + j) * inverse_pivot_[kNew + j] * root.col(j);
    }
  }
  for (int k = 0; k < kDim; ++k) root.col(k) *= std::sqrt(inverse_pivot_[kNew + k]);
  return root;
}

template <int kDim>
BasicTangentMatrix<kDim> inverseRoot(const Eigen::Matrix<double, kDim, kDim>& spd) noexcept {
  using Matrix = BasicTangentMatrix<kDim>;
  const Eigen::LLT<Matrix> llt(spd);
  if (llt.info() != Eigen::Success) return Matrix::Zero();
  return llt.matrixU().solve(Matrix::Identity());
}

template <int kDim>
BasicTangentMatrix<kDim> inverseSpd(const Eigen::Matrix<double, kDim, kDim>& spd) noexcept {
  const BasicTangentMatrix<kDim> root = inverseRoot(spd);
  return root * root.transpose();
}

template class BasicInformationUpdate<kTangentDim>;
template class BasicInformationUpdate<kSpinTangentDim>;
template BasicTangentMatrix<kTangentDim> inverseRoot(const TangentMatrix&) noexcept;
template BasicTangentMatrix<kSpinTangentDim> inverseRoot(
    const BasicTangentMatrix<kSpinTangentDim>&) noexcept;
template BasicTangentMatrix<kTangentDim> inverseSpd(const TangentMatrix&) noexcept;
template BasicTangentMatrix<kSpinTangentDim> inverseSpd(
    const BasicTangentMatrix<kSpinTangentDim>&) noexcept;

}  // namespace ballbot
