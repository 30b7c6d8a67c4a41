#include "controller/frozen_arm.hpp"

#include <Eigen/Geometry>

namespace ballbot {
namespace {

/// Of what is left at the joints [kg m^2]: so much that joint feedback made for the real arm is slow
/// beside the planner's steps.
constexpr double kLeftOver = 0.2;
/// A centre of mass needs some mass; so little changes nothing that could be measured [kg].
constexpr double kLeftOverMass = 1e-9;

BodyInertia turned(const BodyInertia& body, const Matrix3& R) {
  return {body.mass, R * body.p_LLcm_L, R * body.I_LLcm_L * R.transpose()};
}

}  // namespace

RobotParameters withFrozenArm(const RobotParameters& robot, const Vector3& arm) {
  RobotParameters out = robot;
  out.payload_mass = 0;
  Matrix3 R_BA = Matrix3::Identity();
  Vector3 p_BA = Vector3::Zero();
  for (int i = 0; i < kArmJointCount; ++i) {
    ArmLink& link = out.arm[i];
    const bool last = i == kArmJointCount - 1;
    const BodyInertia body = last ? robot.lastLinkWithPayload() : link.inertia;
    p_BA += R_BA * link.p_PJ_P;
    R_BA = R_BA * Eigen::AngleAxisd(arm[i], link.axis).toRotationMatrix();
    out.base = composed(out.base, turned(body, R_BA), p_BA);
    link.inertia = {kLeftOverMass, Vector3::Zero(), kLeftOver * link.axis * link.axis.transpose()};
  }
  return out;
}

}  // namespace ballbot
