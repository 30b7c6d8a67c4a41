#pragma once

#include "estimator/information_update.hpp"
#include "estimator/outlier_gate.hpp"
#include "estimator/smooth_velocity.hpp"
#include "estimator/spin_gate.hpp"

namespace ballbot {

/// The recursion of the two-state implicit filter, without clocks, frames and queues: from the
/// state and its information at t_k-1 and the measurements in between to those at t_k.
/// Free of allocation; for the control step.
template <int kDim>
class BasicInformationFilter {
 public:
  using Vector = BasicTangentVector<kDim>;
  using Matrix = BasicTangentMatrix<kDim>;

  /// @param accel_bias_sigma turn-on bias of the accelerometer [m/s^2]
  /// @param iterations per step, at least 2: with one, the linearisation at the old velocity makes
  /// up information about yaw.
  BasicInformationFilter(const RobotParameters& robot, const FilterNoise& noise,
                         const GateSettings& gate, double accel_bias_sigma, int iterations,
                         const SpinSettings& spin = {});

  void initialise(const FilterState& x, const Matrix& information) noexcept;

  /// One interval. Counts what it leaves out. If nothing usable comes out the state stays, moved
  /// on by the inertial measurement, with relaxed information.
  void step(const IntervalMeasurement& m, RejectionCounts& counts) noexcept;

  /// Measurement of the state alone, of which the spin is no part, in rows of unit variance:
  /// 0 = y + H dx.
  void addRows(const Eigen::Matrix<double, 3, kTangentDim>& H, const Vector3& y) noexcept;
  /// The robot stands turned by `angle` about the vertical from what was believed: attitude and
  /// velocity turn exactly, and the position about the point from which it became uncertain with
  /// yaw, which is where yaw was last known. No inertial or wheel residual changes [rad].
  void turn(double angle) noexcept;
  /// The state fits no measurement: forgets what it knew of tilt, velocity and accelerometer bias.
  /// Position and yaw, which no measurement tells, are left alone.
  void doubt() noexcept;
  /// Adds to the covariance of all but the spin: what was known becomes less certain.
  void relax(const TangentMatrix& extra_covariance) noexcept;

  const FilterState& state() const { return x_; }
  const Matrix& information() const { return information_; }
  Matrix covariance() const noexcept;
  /// Upper triangular C; the covariance is C C'.
  const Matrix& covarianceRoot() const { return covariance_root_; }
  /// Acceleration of the ball centre in W over the last interval [m/s^2].
  const Eigen::Vector2d& acceleration() const { return accel_W_; }

  /// Chi-square of the last step and its degrees of freedom, for the innovation test.
  double nis() const { return nis_; }
  int nisDegrees() const { return nis_degrees_; }
  /// The floor does not hold the ball; never, where the spin is not estimated.
  bool spinning() const { return spin_gate_.spinning(); }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.x_);
    visit(self.information_);
    visit(self.covariance_root_);
    visit(self.smooth_velocity_);
    visit(self.accel_W_);
    visit(self.gate_);
    visit(self.spin_gate_);
    visit(self.nis_);
    visit(self.nis_degrees_);
  }

 private:
  bool solveWithoutOutliers(IntervalMeasurement& m, FilterState& next,
                            std::array<bool, kWheelCount>& use, RejectionCounts& counts) noexcept;
  bool refuseOutliers(IntervalMeasurement& m, const FilterState& next,
                      std::array<bool, kWheelCount>& use) noexcept;
  double commonPart() const noexcept;
  void setInformation(const Matrix& information) noexcept;

  static constexpr bool kSpins = kDim > kTanSpin;

  ResidualModel model_;
  GateSettings gate_settings_;
  double accel_bias_sigma_;  ///< [m/s^2]
  int iterations_;
  Residuals residuals_;                  ///< workspace
  BasicInformationUpdate<kDim> update_;  ///< workspace

  FilterState x_;
  Matrix information_ = Matrix::Identity();
  Matrix covariance_root_ = Matrix::Identity();
  SmoothVelocity smooth_velocity_;
  Eigen::Vector2d accel_W_ = Eigen::Vector2d::Zero();
  WheelGate gate_;
  SpinGate spin_gate_;
  double nis_ = 0;
  int nis_degrees_ = 0;
};
using InformationFilter = BasicInformationFilter<kTangentDim>;

}  // namespace ballbot
