#include "plant/wheel_rolling.hpp"

#include <Eigen/Geometry>

namespace ballbot {

WheelRolling::WheelRolling(const RobotParameters& robot)
    : ball_radius_(robot.ball.radius), ratio_(robot.ball.radius / robot.wheels.radius) {
  for (int i = 0; i < kWheelCount; ++i) axles_B_.col(i) = robot.wheelAxle(i);
}

Vector3 WheelRolling::ballRate(const Vector3& v_WK_W, double ball_spin) const {
  return {-v_WK_W.y() / ball_radius_, v_WK_W.x() / ball_radius_, ball_spin};
}

Vector3 WheelRolling::rates(const Matrix3& R_WB, const Vector3& v_WK_W, const Vector3& w_WB_W,
                            double ball_spin) const {
  const Vector3 relative_B = R_WB.transpose() * (ballRate(v_WK_W, ball_spin) - w_WB_W);
  return -ratio_ * (axles_B_.transpose() * relative_B);
}

Vector3 WheelRolling::bias(const BaseMotion& base) const {
  const Vector3 turning = base.w_WB_W.cross(ballRate(base.v_WK_W, base.ball_spin));
  return ratio_ * (axles_B_.transpose() * (base.R_WB.transpose() * turning));
}

SharedRow WheelRolling::row(const Matrix3& R_WB, int wheel) const {
  const Vector3 d = R_WB * axles_B_.col(wheel);
  const double per_radius = ratio_ / ball_radius_;
  SharedRow row{};
  row[0] = -per_radius * d.y();
  row[1] = per_radius * d.x();
  for (int k = 0; k < 3; ++k) row[kOmegaU + k] = ratio_ * d[k];
  row[kSpinU] = -ratio_ * d.z();
  return row;
}

std::array<ActuatorMount, kJointCount> actuatorMounts(const RobotParameters& robot) {
  std::array<ActuatorMount, kJointCount> mounts;
  for (int i = 0; i < kWheelCount; ++i) {
    mounts[i] = {kBaseBody, robot.wheelAxle(i), robot.wheelCentre(i)};
  }
  for (int j = 0; j < kArmJointCount; ++j) {
    mounts[kWheelCount + j] = {static_cast<BodyIndex>(kBaseBody + j), robot.arm[j].axis,
                               robot.arm[j].p_PJ_P};
  }
  return mounts;
}

}  // namespace ballbot
