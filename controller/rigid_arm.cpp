#include "controller/rigid_arm.hpp"

#include <Eigen/Geometry>

namespace ballbot {
namespace {

BodyInertia turned(const BodyInertia& body, const Matrix3& R) {
  return {body.mass, R * body.p_LLcm_L, R * body.I_LLcm_L * R.transpose()};
}

}  // namespace

RobotParameters withRigidArm(const RobotParameters& robot, const ArmVector& arm) {
  RobotParameters out = robot;
  out.payload_mass = 0;
  Matrix3 R_BA = Matrix3::Identity();
  Vector3 p_BA = Vector3::Zero();
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    const bool last = i == kArmJointCount - 1;
    const BodyInertia body = last ? robot.lastLinkWithPayload() : link.inertia;
    p_BA += R_BA * link.p_PJ_P;
    if (link.slides()) {
      p_BA += arm[i] * (R_BA * link.slide());
    } else {
      R_BA = R_BA * Eigen::AngleAxisd(arm[i], link.axis).toRotationMatrix();
    }
    out.base = composed(out.base, turned(body, R_BA), p_BA);
    out.arm[i].inertia = BodyInertia();
  }
  return out;
}

}  // namespace ballbot
