#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/state.hpp"

namespace ballbot {

class ConfigVisitor;

/// What the parts of the robot are called in its URDF.
struct RobotLinks {
  RobotLinks();

  std::string base = "base", ball = "ball";
  std::array<std::string, kWheelCount> wheels;             ///< "wheel_1", ...
  std::array<std::string, kArmJointCount> arm;             ///< from the base on: "arm_1", ...
  std::string end_effector = "end_effector", imu = "imu";  ///< frames

  /// Those that move against each other: all but the frames.
  std::vector<std::string> bodies() const;
  std::vector<std::string> all() const;

  /// A reader refuses a name that stands for two.
  void describe(ConfigVisitor& v);
};

}  // namespace ballbot
