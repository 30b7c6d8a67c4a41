#include "model/omniwheel_kinematics.hpp"

#include <Eigen/LU>

namespace ballbot {

OmniwheelKinematics::OmniwheelKinematics(const RobotParameters& robot)
    : ball_radius_(robot.ball.radius), ratio_(robot.ball.radius / robot.wheels.radius) {
  for (int i = 0; i < kWheelCount; ++i) axles_.row(i) = robot.wheelAxle(i).transpose();
  axles_inverse_ = axles_.inverse();
}

Vector3 OmniwheelKinematics::wheelRates(const Vector3& kappa_B, const Vector3& w_WB_B) const {
  return -ratio_ * (axles_ * (kappa_B - w_WB_B));
}

Vector3 OmniwheelKinematics::ballAngularVelocity(const Vector3& wheel_rates,
                                                 const Vector3& w_WB_B) const {
  return w_WB_B - axles_inverse_ * wheel_rates / ratio_;
}

Vector3 OmniwheelKinematics::ballTorque(const Vector3& wheel_torques) const {
  return -ratio_ * (axles_.transpose() * wheel_torques);
}

Vector3 OmniwheelKinematics::wheelTorques(const Vector3& ball_torque_B) const {
  return axles_inverse_.transpose() * ball_torque_B / -ratio_;
}

Vector3 OmniwheelKinematics::rollingAngularVelocity(double vx, double vy, double radius) {
  return {-vy / radius, vx / radius, 0};
}

Eigen::Matrix<double, kWheelCount, kVelocityDim> OmniwheelKinematics::wheelRows(
    const Matrix3& R_WB) const {
  Eigen::Matrix<double, kWheelCount, kVelocityDim> rows;
  // kappa = R^T (-vy/r, vx/r, 0), so the columns of R^T J_K are rows of R over r.
  rows.col(kBallVx) = -ratio_ / ball_radius_ * (axles_ * R_WB.row(1).transpose());
  rows.col(kBallVy) = ratio_ / ball_radius_ * (axles_ * R_WB.row(0).transpose());
  rows.middleCols<3>(kOmegaX) = ratio_ * axles_;
  rows.rightCols<kArmJointCount>().setZero();
  return rows;
}

}  // namespace ballbot
