#pragma once

#include <array>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// Where a body stands: its origin [m] and its axes, in W.
struct BodyPose {
  Vector3 p_WL = Vector3::Zero();
  Matrix3 R_WL = Matrix3::Identity();
};

/// Base (origin at the ball's centre) and the links of the arm, in order.
std::array<BodyPose, 1 + kArmJointCount> bodyPoses(const RobotParameters& robot,
                                                   const StateVector& x);

}  // namespace ballbot
