#pragma once

#include <array>

#include "estimator/filter_state.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {

class ConfigVisitor;

/// Noise of sensors and of the random walks, one standard deviation. Figures of the MTi-1 class.
struct FilterNoise {
  double gyro_density = 1.2e-4;   ///< [rad/s/sqrt(Hz)]
  double accel_density = 1.2e-3;  ///< [m/s^2/sqrt(Hz)]
  double accel_inflation = 3;     ///< factor on the accelerometer's, for vibration
  double gyro_bias_walk = 2e-5;   ///< [rad/s/sqrt(s)]
  double accel_bias_walk = 3e-4;  ///< [m/s^2/sqrt(s)]
  double wheel_increment =
      2.5e-4;                   ///< of a wheel's turn over an interval, 0.1 rad/s at 400 Hz [rad]
  double position_walk = 1e-4;  ///< micro-slip and integration rule [m/sqrt(s)]
  double attitude_walk = 4e-5;  ///< integration rule [rad/sqrt(s)]
  double coasting_accel = 3;    ///< of the ball, while no accelerometer tells [m/s^2]
  double coasting_angular_accel = 10;  ///< of the base, while no gyroscope tells [rad/s^2]

  void describe(ConfigVisitor& v);
};

/// What was measured between two instants h apart.
struct IntervalMeasurement {
  double h = 0;  ///< [s]
  bool has_accel = false, has_gyro = false;
  Vector3 accel_B = Vector3::Zero();  ///< mean specific force at the IMU [m/s^2]
  Vector3 gyro_B = Vector3::Zero();   ///< mean angular velocity [rad/s]
  std::array<bool, kWheelCount> has_wheel{};
  Vector3 wheel_increment = Vector3::Zero();  ///< turn relative to the base [rad]
  /// Velocity of the ball centre in W, at begin and end, at which residuals are differentiated by
  /// attitude (smooth_velocity.hpp says why that is not the estimate) [m/s].
  Eigen::Vector2d smooth_v_old_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d smooth_v_new_W = Eigen::Vector2d::Zero();
  /// Of the wheels on the ball about the vertical, under which a held ball creeps [N m].
  double spin_load = 0;
  /// The ball's spin is so much of that of the interval before, and noise of one standard deviation
  /// of `spin_sigma` [rad/s].
  double spin_kept = 1, spin_sigma = 1;
  /// Spin at which the wheels' residuals are differentiated by attitude: one that has none of this
  /// interval's noise [rad/s].
  double smooth_spin = 0;
};

/// First row of each residual.
enum ResidualRow : int {
  kRowPosition = 0,  ///< 2 rows
  kRowAttitude = 2,  ///< 3 rows, as all that follow
  kRowAccel = 5,
  kRowGyro = 8,
  kRowWheels = 11,
  kRowAccelBias = 14,
  kRowGyroBias = 17,
  kRowSpin = 20,  ///< 1 row, for a filter that estimates the spin
};
constexpr int kResidualDim = 21;
using ResidualVector = Eigen::Matrix<double, kResidualDim, 1>;
using ResidualJacobian = Eigen::Matrix<double, kResidualDim, kSpinTangentDim>;

/// Residuals between two consecutive states, divided by their standard deviations, and their
/// derivatives by the tangents of the old and the new state.
struct Residuals {
  ResidualVector y = ResidualVector::Zero();
  ResidualJacobian d_old = ResidualJacobian::Zero();
  ResidualJacobian d_new = ResidualJacobian::Zero();
};

/// The residuals of the two-state implicit filter (Bloesch et al., "The Two-State Implicit
/// Filter", RA-L 2018) for a ball that rolls on a level floor without slip. Old state "-",
/// f(R, v) = -(r/r_w) D R' J v the wheel rates of the rolling ball, J v = (z x v) / r, and
/// n(R) = -(r/r_w) D R' z those of a ball that spins about the vertical with 1 rad/s:
///
///   position      p - p- - h (v + v-)/2
///   attitude      log(R-' R) - h w
///   accelerometer mean(R', R-') [(v - v-)/h; g] + (w - w-)/h x p_BI + w x (w x p_BI) + b_a - accel
///   gyroscope     w + b_g - gyro
///   wheels        (f(R, v) + f(R-, v-))/2 + (n(R) + n(R-))/2 s + (r/r_w) D w - increment/h
///   biases        b - b-
///   spin          s - spin_kept s-
///
/// w and s are means over the interval. A filter that takes the spin for zero leaves out the last
/// row and the last column. Where accelerometer or gyroscope are missing, their rows say that
/// velocity and angular velocity change slowly. Free of allocation; for the control step.
class ResidualModel {
 public:
  ResidualModel(const RobotParameters& robot, const FilterNoise& noise);

  /// Writes the same entries of `out` every time; `out` must have begun as zero. Rows of missing
  /// wheels are written too; who solves leaves them out.
  void evaluate(const FilterState& old_state, const FilterState& new_state,
                const IntervalMeasurement& m, Residuals& out) const noexcept;

  /// The new state that the inertial measurement alone leads to: where to linearise first.
  FilterState predict(const FilterState& old_state, const IntervalMeasurement& m) const noexcept;

  /// Mean acceleration of the ball centre over an interval, in W [m/s^2].
  Vector3 ballAcceleration(const FilterState& old_state, const FilterState& new_state,
                           const IntervalMeasurement& m) const noexcept;

 private:
  Vector3 leverArmForce(const Vector3& w_old, const Vector3& w_new, double h) const noexcept;
  void kinematicRows(const FilterState& a, const FilterState& b, double h,
                     Residuals& out) const noexcept;
  void accelRows(const FilterState& a, const FilterState& b, const IntervalMeasurement& m,
                 Residuals& out) const noexcept;
  void gyroRows(const FilterState& a, const FilterState& b, const IntervalMeasurement& m,
                Residuals& out) const noexcept;
  void wheelRows(const FilterState& a, const FilterState& b, const IntervalMeasurement& m,
                 Residuals& out) const noexcept;
  void spinRows(const FilterState& a, const FilterState& b, const IntervalMeasurement& m,
                Residuals& out) const noexcept;

  FilterNoise noise_;
  double gravity_;          ///< [m/s^2]
  Vector3 p_BI_B_;          ///< [m]
  Matrix3 p_BI_cross_;      ///< skew(p_BI)
  Matrix3 base_to_wheels_;  ///< (r/r_w) D: wheel rates of a turning base
  double ball_radius_;      ///< [m]
};

}  // namespace ballbot
