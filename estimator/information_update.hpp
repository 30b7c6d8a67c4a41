#pragma once

#include <array>

#include "estimator/residuals.hpp"

namespace ballbot {

/// Gauss-Newton step of the two-state implicit filter in information form. The cost
///
///   1/2 d_old' Lambda d_old + 1/2 |y + J_old d_old + J_new d_new|^2
///
/// is written as one symmetric matrix over (d_old, d_new, 1, wheel residuals) and eliminated from
/// the top left. After the old state's columns (the marginalisation) the new state's block is its
/// information Lambda+ = J_new'(1 - J_old (Lambda + J_old' J_old)^-1 J_old')J_new; after those of
/// the new state too the last rows hold the minimum of the cost and, for every wheel, its residual
/// at the minimum with the variance of what the others say about it. The blocks' sparsity is used.
/// Free of allocation; for the control step.
template <int kDim>
class BasicInformationUpdate {
 public:
  using Vector = BasicTangentVector<kDim>;
  using Matrix = BasicTangentMatrix<kDim>;

  /// @param information of the old state, at d_old = 0; @param use_wheel rows that count.
  /// @return false where the system is not positive definite; then nothing below holds.
  [[nodiscard]] bool solve(const Matrix& information, const Residuals& r,
                           const std::array<bool, kWheelCount>& use_wheel) noexcept;

  /// Of the new state; both halves are filled.
  const Matrix& information() const { return information_; }
  /// d_new at the minimum.
  const Vector& delta() const { return delta_; }
  /// Twice the cost at the minimum: chi-square with (rows that count - kDim) degrees of freedom.
  double chiSquare() const { return system_(kRhs, kRhs); }

  /// Residual of a wheel in standard deviations of what it should be, at the minimum, whether its
  /// row counts or not.
  double standardizedWheel(int i) const noexcept;
  Vector3 standardizedWheels() const noexcept {
    return {standardizedWheel(0), standardizedWheel(1), standardizedWheel(2)};
  }
  /// The same for something that shifts the rows of all wheels that count in proportion to `shift`.
  double standardizedShift(const Vector3& shift) const noexcept;

  /// Upper triangular root C of the new state's covariance, which is C C'.
  Matrix covarianceRoot() const noexcept;

 private:
  /// Elimination goes by fours: a state's columns are filled up by unknowns that occur nowhere.
  static constexpr int kNew = (kDim + 3) / 4 * 4;  ///< first column of the new state
  static constexpr int kRhs = 2 * kNew;
  static constexpr int kSize = kRhs + 4;
  using System = Eigen::Matrix<double, kSize, kSize>;

  template <int kRow, int kRows, int kOld, int kOldCount, int kNewFrom, int kNewCount>
  void addRows(const Residuals& r) noexcept;
  template <std::size_t kCount>
  void addSparseRow(double y, const std::array<int, kCount>& column,
                    const std::array<double, kCount>& coefficient) noexcept;
  void addDiagonalRows(const Residuals& r) noexcept;
  template <int kRow>
  void addWheel(const Residuals& r) noexcept;

  System system_;
  Eigen::Matrix<double, kSize, 1> inverse_pivot_;
  Matrix information_ = Matrix::Zero();
  Vector delta_ = Vector::Zero();
  std::array<bool, kWheelCount> use_wheel_{};
};
using InformationUpdate = BasicInformationUpdate<kTangentDim>;

/// Upper triangular C with C C' the inverse of a symmetric positive definite matrix, of which the
/// lower half is read; zero where it is not positive definite.
template <int kDim>
BasicTangentMatrix<kDim> inverseRoot(const Eigen::Matrix<double, kDim, kDim>& spd) noexcept;
/// The inverse itself.
template <int kDim>
BasicTangentMatrix<kDim> inverseSpd(const Eigen::Matrix<double, kDim, kDim>& spd) noexcept;

}  // namespace ballbot
