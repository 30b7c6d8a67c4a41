#include "model/frame_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

#include "model/body_poses.hpp"

namespace ballbot {
namespace {

constexpr const char* kBase = "base";
constexpr const char* kEndEffector = "end_effector";

}  // namespace

std::vector<std::string> frameBodies(const RobotParameters& robot) {
  std::vector<std::string> out = {kBase};
  for (const ArmLink& link : robot.arm) out.push_back(link.name);
  if (std::find(out.begin(), out.end(), kEndEffector) == out.end()) out.push_back(kEndEffector);
  return out;
}

RobotFrame frameOf(const RobotParameters& robot, const std::string& body) {
  RobotFrame frame;
  if (body == kBase) return frame;
  for (int i = 0; i < kArmJointCount; ++i) {
    if (robot.arm[i].name != body) continue;
    frame.body = i + 1;
    return frame;
  }
  if (body != kEndEffector) throw std::out_of_range("the robot has no body '" + body + "'");
  return {kArmJointCount, robot.p_A3E, robot.R_A3E};
}

FrameKinematics frameKinematics(const RobotParameters& robot, const RobotFrame& frame,
                                const StateVector& x) {
  const auto bodies = bodyPoses(robot, x);
  const BodyPose& body = bodies[static_cast<std::size_t>(frame.body)];
  FrameKinematics out;
  out.p_WF = body.p_WL + body.R_WL * frame.p_LF;
  out.R_WF = body.R_WL * frame.R_LF;
  out.dpose_dq.setZero();
  out.dpose_dq(0, kBallX) = out.dpose_dq(1, kBallY) = 1;
  const auto turn = [&](int coordinate, const Vector3& axis_W, const Vector3& p_WJ) {
    out.dpose_dq.col(coordinate).head<3>() = axis_W.cross(out.p_WF - p_WJ);
    out.dpose_dq.col(coordinate).tail<3>() = axis_W;
  };
  const Vector3& p_WK = bodies[0].p_WL;
  turn(kYaw, Vector3::UnitZ(), p_WK);
  turn(kPitch, Vector3(-std::sin(x[kYaw]), std::cos(x[kYaw]), 0), p_WK);
  turn(kRoll, bodies[0].R_WL.col(0), p_WK);
  for (int i = 0; i < frame.body; ++i) {
    const BodyPose& link = bodies[static_cast<std::size_t>(i + 1)];
    if (robot.arm[i].slides()) {
      out.dpose_dq.col(kArm1 + i).head<3>() = link.R_WL * robot.arm[i].slide();
    } else {
      turn(kArm1 + i, link.R_WL * robot.arm[i].axis, link.p_WL);
    }
  }
  return out;
}

}  // namespace ballbot
