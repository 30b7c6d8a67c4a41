#include "estimator/residuals.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "core/config_visitor.hpp"
#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

using Matrix32 = Eigen::Matrix<double, 3, 2>;

/// J: angular velocity in W of a ball of this radius from the velocity of its centre.
Matrix32 rollingMatrix(double radius) {
  Matrix32 J;
  J << 0, -1, 1, 0, 0, 0;
  return J / radius;
}

}  // namespace

void FilterNoise::describe(ConfigVisitor& v) {
  v.number(may("gyro_rad_per_s_per_sqrt_Hz", "density of the gyroscope's white noise"),
           gyro_density, {1e-7, 1});
  v.number(may("accel_m_per_s2_per_sqrt_Hz", "density of the accelerometer's white noise"),
           accel_density, {1e-6, 10});
  v.number(may("accel_inflation", "factor on the accelerometer's noise, for vibration"),
           accel_inflation, {1, 100});
  v.number(may("gyro_bias_walk_rad_per_s_per_sqrt_s", "random walk of the gyroscope's bias"),
           gyro_bias_walk, {1e-9, 1});
  v.number(may("accel_bias_walk_m_per_s2_per_sqrt_s", "random walk of the accelerometer's bias"),
           accel_bias_walk, {1e-8, 1});
  v.number(may("wheel_increment_rad", "noise of a wheel's turn over an interval of the IMU"),
           wheel_increment, {1e-6, 0.1});
  v.number(may("position_walk_m_per_sqrt_s",
               "random walk of the position, for micro-slip and integration rule"),
           position_walk, {1e-6, 0.1});
  v.number(
      may("attitude_walk_rad_per_sqrt_s", "random walk of the attitude, for the integration rule"),
      attitude_walk, {1e-6, 0.1});
  v.number(may("coasting_accel_m_per_s2", "of the ball, while no accelerometer tells"),
           coasting_accel, {0.1, 100});
  v.number(may("coasting_angular_accel_rad_per_s2", "of the base, while no gyroscope tells"),
           coasting_angular_accel, {0.1, 1000});
}

ResidualModel::ResidualModel(const RobotParameters& robot, const FilterNoise& noise)
    : noise_(noise),
      gravity_(robot.gravity),
      p_BI_B_(robot.p_BI_B),
      p_BI_cross_(skew(robot.p_BI_B)),
      ball_radius_(robot.ball.radius) {
  const OmniwheelKinematics kinematics(robot);
  for (int i = 0; i < 3; ++i) {
    base_to_wheels_.col(i) = kinematics.wheelRates(Vector3::Zero(), Vector3::Unit(i));
  }
}

Vector3 ResidualModel::leverArmForce(const Vector3& w_old, const Vector3& w_new,
                                     double h) const noexcept {
  return (w_new - w_old).cross(p_BI_B_) / h + w_new.cross(w_new.cross(p_BI_B_));
}

FilterState ResidualModel::predict(const FilterState& old_state,
                                   const IntervalMeasurement& m) const noexcept {
  FilterState next = old_state;
  next.spin *= m.spin_kept;
  if (m.has_gyro) next.w_WB_B = m.gyro_B - old_state.gyro_bias;
  next.R_WB = orthonormalized(old_state.R_WB * expSO3(m.h * next.w_WB_B));
  if (m.has_accel) {
    next.v_WK_W += m.h * ballAcceleration(old_state, next, m).head<2>();
  }
  next.p_WK_W += 0.5 * m.h * (old_state.v_WK_W + next.v_WK_W);
  return next;
}

Vector3 ResidualModel::ballAcceleration(const FilterState& old_state, const FilterState& new_state,
                                        const IntervalMeasurement& m) const noexcept {
  const Vector3 force =
      m.accel_B - new_state.accel_bias - leverArmForce(old_state.w_WB_B, new_state.w_WB_B, m.h);
  return 0.5 * (old_state.R_WB + new_state.R_WB) * force - gravity_ * Vector3::UnitZ();
}

void ResidualModel::evaluate(const FilterState& old_state, const FilterState& new_state,
                             const IntervalMeasurement& m, Residuals& out) const noexcept {
  kinematicRows(old_state, new_state, m.h, out);
  accelRows(old_state, new_state, m, out);
  gyroRows(old_state, new_state, m, out);
  wheelRows(old_state, new_state, m, out);
  spinRows(old_state, new_state, m, out);
}

void ResidualModel::kinematicRows(const FilterState& a, const FilterState& b, double h,
                                  Residuals& out) const noexcept {
  const double root_h = std::sqrt(h);
  const double sp = 1 / (noise_.position_walk * root_h);
  out.y.segment<2>(kRowPosition) = sp * (b.p_WK_W - a.p_WK_W - 0.5 * h * (b.v_WK_W + a.v_WK_W));
  out.d_new.block<2, 2>(kRowPosition, kTanPosition).diagonal().setConstant(sp);
  out.d_old.block<2, 2>(kRowPosition, kTanPosition).diagonal().setConstant(-sp);
  out.d_new.block<2, 2>(kRowPosition, kTanVelocity).diagonal().setConstant(-0.5 * h * sp);
  out.d_old.block<2, 2>(kRowPosition, kTanVelocity).diagonal().setConstant(-0.5 * h * sp);

  const double sr = 1 / (noise_.attitude_walk * root_h);
  const Vector3 turn = logSO3(a.R_WB.transpose() * b.R_WB);
  const Matrix3 J = sr * inverseRightJacobian(turn);
  out.y.segment<3>(kRowAttitude) = sr * (turn - h * b.w_WB_B);
  out.d_new.block<3, 3>(kRowAttitude, kTanAttitude) = J;
  out.d_old.block<3, 3>(kRowAttitude, kTanAttitude) = -J.transpose();
  out.d_new.block<3, 3>(kRowAttitude, kTanOmega).diagonal().setConstant(-h * sr);

  const double sa = 1 / (noise_.accel_bias_walk * root_h);
  out.y.segment<3>(kRowAccelBias) = sa * (b.accel_bias - a.accel_bias);
  out.d_new.block<3, 3>(kRowAccelBias, kTanAccelBias).diagonal().setConstant(sa);
  out.d_old.block<3, 3>(kRowAccelBias, kTanAccelBias).diagonal().setConstant(-sa);
  const double sg = 1 / (noise_.gyro_bias_walk * root_h);
  out.y.segment<3>(kRowGyroBias) = sg * (b.gyro_bias - a.gyro_bias);
  out.d_new.block<3, 3>(kRowGyroBias, kTanGyroBias).diagonal().setConstant(sg);
  out.d_old.block<3, 3>(kRowGyroBias, kTanGyroBias).diagonal().setConstant(-sg);
}

void ResidualModel::accelRows(const FilterState& a, const FilterState& b,
                              const IntervalMeasurement& m, Residuals& out) const noexcept {
  auto y = out.y.segment<3>(kRowAccel);
  auto R_new = out.d_new.block<3, 3>(kRowAccel, kTanAttitude);
  auto R_old = out.d_old.block<3, 3>(kRowAccel, kTanAttitude);
  auto v_new = out.d_new.block<3, 2>(kRowAccel, kTanVelocity);
  auto v_old = out.d_old.block<3, 2>(kRowAccel, kTanVelocity);
  auto w_new = out.d_new.block<3, 3>(kRowAccel, kTanOmega);
  auto w_old = out.d_old.block<3, 3>(kRowAccel, kTanOmega);
  auto bias = out.d_new.block<3, 3>(kRowAccel, kTanAccelBias);

  const Eigen::Vector2d dv = b.v_WK_W - a.v_WK_W;
  if (!m.has_accel) {
    const double s = 1 / (noise_.coasting_accel * m.h);
    y << s * dv, 0;
    R_new.setZero();
    R_old.setZero();
    w_new.setZero();
    w_old.setZero();
    bias.setZero();
    v_new << s, 0, 0, s, 0, 0;
    v_old = -v_new;
    return;
  }
  const double s = std::sqrt(m.h) / (noise_.accel_inflation * noise_.accel_density);
  const Vector3 a_W(dv.x() / m.h, dv.y() / m.h, gravity_);
  const Vector3 f_new = b.R_WB.transpose() * a_W, f_old = a.R_WB.transpose() * a_W;
  const Vector3 mean_force = 0.5 * (f_new + f_old);
  const Vector3& w = b.w_WB_B;
  y = s * (mean_force + leverArmForce(a.w_WB_B, w, m.h) + b.accel_bias - m.accel_B);
  const Eigen::Vector2d dv_smooth = m.smooth_v_new_W - m.smooth_v_old_W;
  const Vector3 a_smooth_W(dv_smooth.x() / m.h, dv_smooth.y() / m.h, gravity_);
  R_new = 0.5 * s * skew(b.R_WB.transpose() * a_smooth_W);
  R_old = 0.5 * s * skew(a.R_WB.transpose() * a_smooth_W);
  v_new = 0.5 * s / m.h * (a.R_WB + b.R_WB).transpose().leftCols<2>();
  v_old = -v_new;
  // w x (w x p) differentiates to -(w x p)x - (w)x (p)x.
  w_old = s / m.h * p_BI_cross_;
  w_new = -w_old - s * (skew(w.cross(p_BI_B_)) + skew(w) * p_BI_cross_);
  bias = s * Matrix3::Identity();
}

void ResidualModel::gyroRows(const FilterState& a, const FilterState& b,
                             const IntervalMeasurement& m, Residuals& out) const noexcept {
  auto y = out.y.segment<3>(kRowGyro);
  auto w_new = out.d_new.block<3, 3>(kRowGyro, kTanOmega).diagonal();
  auto w_old = out.d_old.block<3, 3>(kRowGyro, kTanOmega).diagonal();
  auto bias = out.d_new.block<3, 3>(kRowGyro, kTanGyroBias).diagonal();
  if (m.has_gyro) {
    const double s = std::sqrt(m.h) / noise_.gyro_density;
    y = s * (b.w_WB_B + b.gyro_bias - m.gyro_B);
    w_new.setConstant(s);
    w_old.setZero();
    bias.setConstant(s);
  } else {
    const double s = 1 / (noise_.coasting_angular_accel * m.h);
    y = s * (b.w_WB_B - a.w_WB_B);
    w_new.setConstant(s);
    w_old.setConstant(-s);
    bias.setZero();
  }
}

void ResidualModel::wheelRows(const FilterState& a, const FilterState& b,
                              const IntervalMeasurement& m, Residuals& out) const noexcept {
  const double s = m.h / noise_.wheel_increment;
  const Matrix32 J = rollingMatrix(ball_radius_);
  const Vector3 kappa_new = b.R_WB.transpose() * (J * b.v_WK_W);
  const Vector3 kappa_old = a.R_WB.transpose() * (J * a.v_WK_W);
  out.y.segment<3>(kRowWheels) =
      s * (base_to_wheels_ * (b.w_WB_B - 0.5 * (kappa_new + kappa_old)) - m.wheel_increment / m.h);
  const Matrix3 half = -0.5 * s * base_to_wheels_;
  out.d_new.block<3, 3>(kRowWheels, kTanAttitude) =
      half * skew(b.R_WB.transpose() * (J * m.smooth_v_new_W));
  out.d_old.block<3, 3>(kRowWheels, kTanAttitude) =
      half * skew(a.R_WB.transpose() * (J * m.smooth_v_old_W));
  out.d_new.block<3, 2>(kRowWheels, kTanVelocity) = half * (b.R_WB.transpose() * J);
  out.d_old.block<3, 2>(kRowWheels, kTanVelocity) = half * (a.R_WB.transpose() * J);
  out.d_new.block<3, 3>(kRowWheels, kTanOmega) = s * base_to_wheels_;
}

void ResidualModel::spinRows(const FilterState& a, const FilterState& b,
                             const IntervalMeasurement& m, Residuals& out) const noexcept {
  // What the spin adds to the wheels' rows.
  const Vector3 up_new = b.R_WB.row(2), up_old = a.R_WB.row(2);
  const Matrix3 half = -0.5 * m.h / noise_.wheel_increment * base_to_wheels_;
  const Vector3 by_spin = half * (up_new + up_old);
  out.y.segment<3>(kRowWheels) += b.spin * by_spin;
  out.d_new.block<3, 3>(kRowWheels, kTanAttitude) += m.smooth_spin * half * skew(up_new);
  out.d_old.block<3, 3>(kRowWheels, kTanAttitude) += m.smooth_spin * half * skew(up_old);
  out.d_new.block<3, 1>(kRowWheels, kTanSpin) = by_spin;

  out.y[kRowSpin] = (b.spin - m.spin_kept * a.spin) / m.spin_sigma;
  out.d_new(kRowSpin, kTanSpin) = 1 / m.spin_sigma;
  out.d_old(kRowSpin, kTanSpin) = -m.spin_kept / m.spin_sigma;
}

}  // namespace ballbot
