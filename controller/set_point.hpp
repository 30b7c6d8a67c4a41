#pragma once

#include <Eigen/Core>

#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// Where the robot should stand.
struct SetPoint {
  Eigen::Vector2d ball_position = Eigen::Vector2d::Zero();  ///< in W [m]
  double yaw = 0;                                           ///< continuous, may exceed a turn [rad]
  ArmVector arm = ArmVector::Zero();                        ///< joint angles [rad]

  void describe(ConfigVisitor& v);
  /// The arm within its joints' limits.
  /// @param in  where it was read, for the error's words
  /// @throw InputError
  void requireWithinLimits(const ConfigReader& in, const RobotParameters& robot) const;
};

}  // namespace ballbot
