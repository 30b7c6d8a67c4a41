#include "tests/controller/support/lagged_plant.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "model/frames.hpp"

namespace ballbot {

LaggedPlant::LaggedPlant(const RobotParameters& robot, const LagParameters& lag,
                         const StateVector& x)
    : dynamics_(robot), lag_(lag), x_(x), on_the_way_(lag.delay_steps, JointVector::Zero()) {
  joint_angle_.tail<kArmJointCount>() = x.segment<kArmJointCount>(kArm1);
}

JointVector LaggedPlant::jointVelocity() const {
  return dynamics_.selectionMatrix(x_.head<kPositionDim>()) * x_.tail<kVelocityDim>();
}

double LaggedPlant::tilt() const { return std::acos(std::cos(x_[kPitch]) * std::cos(x_[kRoll])); }

StateVector LaggedPlant::derivative(const StateVector& x, const Vector3& push_W) const {
  const Vector3 force = touch ? touch(dynamics_.endEffector(x)) : Vector3(Vector3::Zero());
  StateVector dx = dynamics_.derivative(x, torque_, force);
  if (!push_W.isZero(0)) {
    const Matrix3 R_WB = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
    const Vector3 p_KP_B(0, 0, 0.35);
    VelocityVector push = VelocityVector::Zero();
    push.head<2>() = push_W.head<2>();
    push.segment<3>(kOmegaX) = p_KP_B.cross(R_WB.transpose() * push_W);
    dx.tail<kVelocityDim>() += dynamics_.massMatrix(x.head<kPositionDim>()).llt().solve(push);
  }
  return dx;
}

void LaggedPlant::step(const JointVector& command, const Vector3& push_W) {
  on_the_way_.push_back(command);
  const JointVector arrived = on_the_way_.front();
  on_the_way_.pop_front();
  const double w = 2 * M_PI * lag_.bandwidth_Hz;
  torque_rate_ += kStep * (w * w * (arrived - torque_) - 2 * lag_.damping_ratio * w * torque_rate_);
  torque_ += kStep * torque_rate_;

  const double h = kStep;
  const JointVector rate_before = jointVelocity();
  const StateVector k1 = derivative(x_, push_W);
  const StateVector k2 = derivative(x_ + 0.5 * h * k1, push_W);
  const StateVector k3 = derivative(x_ + 0.5 * h * k2, push_W);
  const StateVector k4 = derivative(x_ + h * k3, push_W);
  x_ += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  joint_angle_ += 0.5 * h * (rate_before + jointVelocity());
  joint_angle_.tail<kArmJointCount>() = x_.segment<kArmJointCount>(kArm1);
}

}  // namespace ballbot
