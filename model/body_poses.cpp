#include "model/body_poses.hpp"

#include <Eigen/Geometry>

#include "model/frames.hpp"

namespace ballbot {

std::array<BodyPose, 1 + kArmJointCount> bodyPoses(const RobotParameters& robot,
                                                   const StateVector& x) {
  std::array<BodyPose, 1 + kArmJointCount> out;
  out[0].p_WL << x[kBallX], x[kBallY], robot.ball.radius;
  out[0].R_WL = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    out[i + 1].p_WL = out[i].p_WL + out[i].R_WL * link.p_PJ_P;
    if (link.slides()) {
      out[i + 1].p_WL += x[kArm1 + i] * (out[i].R_WL * link.slide());
      out[i + 1].R_WL = out[i].R_WL;
    } else {
      out[i + 1].R_WL = out[i].R_WL * Eigen::AngleAxisd(x[kArm1 + i], link.axis);
    }
  }
  return out;
}

}  // namespace ballbot
