#include "model/wheel_loads.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "model/body_poses.hpp"

namespace ballbot {

WheelLoadModel::WheelLoadModel(const RobotParameters& robot)
    : robot_(robot),
      kinematics_(robot),
      base_(robot.baseWithWheels()),
      last_link_(robot.lastLinkWithPayload()) {
  Matrix3 normals;
  for (int i = 0; i < kWheelCount; ++i) {
    normals.col(i) = robot.contactDirection(i);
    axles_.row(i) = robot.wheelAxle(i).transpose();
    tangents_.col(i) = robot.contactDirection(i).cross(robot.wheelAxle(i));
  }
  along_normals_ = normals.inverse();
}

WheelLoads WheelLoadModel::at(const StateVector& x, const VelocityVector& dnu,
                              const Vector3& wheel_torque, const Vector3& applied_W) const {
  const auto poses = bodyPoses(robot_, x);
  const Matrix3& R_WB = poses[0].R_WL;
  const auto nu = x.tail<kVelocityDim>();
  const Vector3 w_B = nu.segment<3>(kOmegaX), alpha_B = dnu.segment<3>(kOmegaX);

  Vector3 load = -applied_W;
  Vector3 a(dnu[kBallVx], dnu[kBallVy], 0), w = R_WB * w_B, alpha = R_WB * alpha_B;
  const auto carry = [&](const BodyInertia& body, const Matrix3& R_WL) {
    const Vector3 arm = R_WL * body.p_LLcm_L;
    const Vector3 gravity(0, 0, -robot_.gravity);
    load += body.mass * (a + alpha.cross(arm) + w.cross(w.cross(arm)) - gravity);
  };
  carry(base_, R_WB);
  for (int j = 0; j < kArmJointCount; ++j) {
    const BodyPose& link = poses[j + 1];
    const Vector3 r = link.p_WL - poses[j].p_WL;
    a += alpha.cross(r) + w.cross(w.cross(r));
    if (robot_.arm[j].slides()) {
      const Vector3 slide = link.R_WL * robot_.arm[j].slide();
      a += dnu[kArmRate1 + j] * slide + 2 * nu[kArmRate1 + j] * w.cross(slide);
      carry(j + 1 == kArmJointCount ? last_link_ : robot_.arm[j].inertia, link.R_WL);
      continue;
    }
    const Vector3 axis = link.R_WL * robot_.arm[j].axis;
    alpha += dnu[kArmRate1 + j] * axis + nu[kArmRate1 + j] * w.cross(axis);
    w += nu[kArmRate1 + j] * axis;
    carry(j + 1 == kArmJointCount ? last_link_ : robot_.arm[j].inertia, link.R_WL);
  }

  const auto ofBall = [&](const VelocityVector& v) -> Vector3 {
    return R_WB.transpose() *
           OmniwheelKinematics::rollingAngularVelocity(v[kBallVx], v[kBallVy], robot_.ball.radius);
  };
  const Vector3 spin_up =
      kinematics_.wheelRates(ofBall(dnu) - w_B.cross(ofBall(nu)), alpha_B) + axles_ * alpha_B;
  const Vector3 traction =
      (robot_.wheels.spin_inertia * spin_up - wheel_torque) / robot_.wheels.radius;
  return {along_normals_ * (R_WB.transpose() * load - tangents_ * traction), traction};
}

}  // namespace ballbot
