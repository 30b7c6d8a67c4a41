#include "estimator/information_update.hpp"

#include <Eigen/Cholesky>

#include "estimator/partial_cholesky.hpp"

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
  addRows<kRowPosition, 2, kTanPosition, 7, kTanPosition, 7>(r, S);
  addRows<kRowAttitude, 3, kTanAttitude, 3, kTanAttitude, 8>(r, S);
  addRows<kRowAccel, 3, kTanAttitude, 8, kTanAttitude, 11>(r, S);
  addRows<kRowGyro, 3, kTanOmega, 3, kTanOmega, 9>(r, S);
  addRows<kRowAccelBias, 3, kTanAccelBias, 3, kTanAccelBias, 3>(r, S);
  addRows<kRowGyroBias, 3, kTanGyroBias, 3, kTanGyroBias, 3>(r, S);
  if (use_wheel[0]) addWheel<kRowWheels>(r, S);
  if (use_wheel[1]) addWheel<kRowWheels + 1>(r, S);
  if (use_wheel[2]) addWheel<kRowWheels + 2>(r, S);
  use_wheel_ = use_wheel;

  // Rows M of the wheels ride along: below the elimination they become y - M H^-1 g and -M H^-1 M'.
  S.block<3, kTangentDim>(kRhsRow + 1, 0) = r.d_old.middleRows<3>(kRowWheels);
  S.block<3, kTangentDim>(kRhsRow + 1, kNew) = r.d_new.middleRows<3>(kRowWheels);
  S.block<3, 1>(kRhsRow + 1, kRhsRow) = r.y.segment<3>(kRowWheels);

  if (!eliminate<0, kTangentDim>(S)) return false;
  information_ = S.block<kTangentDim, kTangentDim>(kNew, kNew).selfadjointView<Eigen::Lower>();
  if (!eliminate<kTangentDim, kRhsRow>(S)) return false;
  // L' d = -z, with z' = (L^-1 g)' in the row of the right-hand side.
  delta_ = -S.block<1, kTangentDim>(kRhsRow, kNew).transpose();
  S.block<kTangentDim, kTangentDim>(kNew, kNew)
      .triangularView<Eigen::Lower>()
      .transpose()
      .solveInPlace(delta_);
  return delta_.allFinite();
}

double InformationUpdate::standardizedWheel(int i) const noexcept {
  const int row = kRhs + 1 + i;
  const double predicted = -system_(row, row);  // variance of M d at the minimum
  const double variance = use_wheel_[static_cast<std::size_t>(i)] ? 1 - predicted : 1 + predicted;
  return variance > 1e-6 ? system_(row, kRhs) / std::sqrt(variance) : 0.0;
}

TangentMatrix InformationUpdate::covariance() const noexcept {
  TangentMatrix L_inverse = TangentMatrix::Identity();
  system_.block<kTangentDim, kTangentDim>(kNew, kNew)
      .triangularView<Eigen::Lower>()
      .solveInPlace(L_inverse);
  return L_inverse.transpose().lazyProduct(L_inverse);
}

TangentMatrix covarianceFrom(const TangentMatrix& information) noexcept {
  const Eigen::LLT<TangentMatrix> llt(information);
  if (llt.info() != Eigen::Success) return TangentMatrix::Zero();
  return llt.solve(TangentMatrix::Identity());
}

}  // namespace ballbot
