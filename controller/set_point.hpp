#pragma once

#include <Eigen/Core>

#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;

/// Where the robot should stand.
struct SetPoint {
  Eigen::Vector2d ball_position = Eigen::Vector2d::Zero();  ///< in W [m]
  double yaw = 0;                                           ///< continuous, may exceed a turn [rad]
  Vector3 arm = Vector3::Zero();                            ///< joint angles [rad]

  /// Keys: ball_position_m, yaw_rad, arm_rad (default: the robot's nominal arm pose, and within
  /// its joint limits).
  static SetPoint read(ConfigReader& in, const RobotParameters& robot);
};

}  // namespace ballbot
