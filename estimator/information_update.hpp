#pragma once

#include <array>

#include "estimator/residuals.hpp"

namespace ballbot {

/// Gauss-Newton step of the two-state implicit filter in information form. The cost
///
///   1/2 d_old' Lambda d_old + 1/2 |y + J_old d_old + J_new d_new|^2
///
/// is written as one symmetric matrix over (d_old, d_new, 1, wheel residuals) and eliminated from
/// the top left. After the old state's 16 columns (the marginalisation) the new state's block is
/// its information Lambda+ = J_new'(1 - J_old (Lambda + J_old' J_old)^-1 J_old')J_new; after all
/// 32 columns the last rows hold the minimum of the cost and, for every wheel, its residual at the
/// minimum with the variance of what the others say about it. The blocks' sparsity is used.
/// Free of allocation; for the control step.
class InformationUpdate {
 public:
  /// @param information of the old state, at d_old = 0; @param use_wheel rows that count.
  /// @return false where the system is not positive definite; then nothing below holds.
  [[nodiscard]] bool solve(const TangentMatrix& information, const Residuals& r,
                           const std::array<bool, kWheelCount>& use_wheel) noexcept;

  /// Of the new state; both halves are filled.
  const TangentMatrix& information() const { return information_; }
  /// d_new at the minimum.
  const TangentVector& delta() const { return delta_; }
  /// Twice the cost at the minimum: chi-square with (rows that count - 16) degrees of freedom.
  double chiSquare() const { return system_(kRhs, kRhs); }

  /// Residual of a wheel in standard deviations of what it should be, at the minimum, whether its
  /// row counts or not.
  double standardizedWheel(int i) const noexcept;

  /// Upper triangular root C of the new state's covariance, which is C C'.
  TangentMatrix covarianceRoot() const noexcept;

 private:
  static constexpr int kRhs = 2 * kTangentDim;
  static constexpr int kDim = kRhs + 4;

  Eigen::Matrix<double, kDim, kDim> system_;
  Eigen::Matrix<double, kDim, 1> inverse_pivot_;
  TangentMatrix information_ = TangentMatrix::Zero();
  TangentVector delta_ = TangentVector::Zero();
  std::array<bool, kWheelCount> use_wheel_{};
};

/// Upper triangular C with C C' the inverse of a symmetric positive definite matrix, of which the
/// lower half is read; zero where it is not positive definite.
TangentMatrix inverseRoot(const TangentMatrix& spd) noexcept;
/// The inverse itself.
TangentMatrix inverseSpd(const TangentMatrix& spd) noexcept;

}  // namespace ballbot
