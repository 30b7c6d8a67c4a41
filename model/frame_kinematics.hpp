#pragma once

#include <string>
#include <vector>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// A frame F fixed to a body L of the robot.
struct RobotFrame {
  int body = 0;  ///< 0: base B, with its origin at K; 1 to 3: links of the arm, theirs at the joint
  Vector3 p_LF = Vector3::Zero();      ///< [m]
  Matrix3 R_LF = Matrix3::Identity();  ///< takes F coordinates to L's
};

/// "base", the links of the arm by their names, and "end_effector".
std::vector<std::string> frameBodies(const RobotParameters& robot);
/// The body's own frame; the end-effector's is E in the last link.
/// @throw std::out_of_range for a name that is not in frameBodies().
RobotFrame frameOf(const RobotParameters& robot, const std::string& body);

/// Where a frame is, and how that changes with the robot's coordinates.
struct FrameKinematics {
  Vector3 p_WF;
  Matrix3 R_WF;
  /// Rows: displacement of F, then small rotation of F about axes of W; columns: (px, py, yaw,
  /// pitch, roll, arm joints).
  Eigen::Matrix<double, 6, kPositionDim> dpose_dq;
};
/// Free of allocation.
FrameKinematics frameKinematics(const RobotParameters& robot, const RobotFrame& frame,
                                const StateVector& x);

}  // namespace ballbot
