#include "tests/estimator/support/driven_robot.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot::test {
namespace {

constexpr double kEncoderStep = 0.025 * 0.017453292519943295;  // [rad]
constexpr int kSubsteps = 5;

Vector3 draw(const RandomStream& stream, std::int64_t tick) {
  const auto n = stream.normals(static_cast<std::uint64_t>(tick));
  return {n[0], n[1], n[2]};
}

}  // namespace

DrivenRobot::DrivenRobot(std::uint64_t seed)
    : dynamics_(exampleRobot()),
      lqr_(designLqr(dynamics_, dynamics_.robot().nominal_arm, LqrWeights())),
      gyro_(seed, "gyro"),
      accel_(seed, "accel"),
      x_(lqr_.equilibrium.x) {
  joint_angle_.tail<kArmJointCount>() = x_.segment<kArmJointCount>(kArm1);
}

Vector3 DrivenRobot::imuVelocity() const {
  const Matrix3 R_WB = rotationFromYawPitchRoll(x_[kYaw], x_[kPitch], x_[kRoll]);
  const Vector3 w = x_.segment<3>(kPositionDim + kOmegaX);
  const Vector3 v(x_[kPositionDim], x_[kPositionDim + 1], 0);
  return v + R_WB * w.cross(robot().p_BI_B);
}

JointVector DrivenRobot::torque() const {
  StateVector error = x_ - lqr_.equilibrium.x;
  const double t = time_s() - kRest_s;
  error[kBallX] -= sway_m * std::sin(2.5 * t);
  error[kBallY] -= sway_m * std::sin(1.7 * t);
  return lqr_.equilibrium.tau + gainAtYaw(lqr_.K, x_[kYaw]) * error;
}

void DrivenRobot::advance(const Vector3& force_W) {
  const Vector3 v_before = imuVelocity();
  const Matrix3 R_before = rotationFromYawPitchRoll(x_[kYaw], x_[kPitch], x_[kRoll]);
  Vector3 turned = Vector3::Zero();
  if (!atRest()) {
    const JointVector tau = torque();
    const double h = kPeriod_s / kSubsteps;
    for (int i = 0; i < kSubsteps; ++i) {
      const StateVector k1 = dynamics_.derivative(x_, tau, force_W);
      const StateVector k2 = dynamics_.derivative(x_ + h / 2 * k1, tau, force_W);
      const StateVector k3 = dynamics_.derivative(x_ + h / 2 * k2, tau, force_W);
      const StateVector k4 = dynamics_.derivative(x_ + h * k3, tau, force_W);
      const StateVector step = h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      const StateVector middle = x_ + step / 2;
      joint_angle_ += h * (dynamics_.selectionMatrix(middle.head<kPositionDim>()) *
                           middle.tail<kVelocityDim>());
      turned += h * middle.segment<3>(kPositionDim + kOmegaX);
      x_ += step;
    }
  }
  ++tick_;
  const Matrix3 R_after = rotationFromYawPitchRoll(x_[kYaw], x_[kPitch], x_[kRoll]);
  const Vector3 specific_W =
      (imuVelocity() - v_before) / kPeriod_s + Vector3(0, 0, robot().gravity);

  frame_.time = frame_.imu_time = simTimeFromNs(tick_ * 2500000);
  frame_.imu_count = tick_;
  frame_.accel_B = 0.5 * (R_before + R_after).transpose() * specific_W + accel_bias +
                   0.024 * draw(accel_, tick_);
  frame_.gyro_WB_B = turned / kPeriod_s + 2.4e-3 * draw(gyro_, tick_);
  frame_.joint_angle = (joint_angle_ / kEncoderStep).array().round() * kEncoderStep;
}

}  // namespace ballbot::test
