#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/state.hpp"

namespace ballbot {

class ConfigVisitor;

/// What the parts of the robot are called in its URDF.
struct RobotLinks {
  std::string base = "base", ball = "ball";
  std::array<std::string, kWheelCount> wheels{"wheel_1", "wheel_2", "wheel_3"};
  std::array<std::string, kArmJointCount> arm{"arm_1", "arm_2", "arm_3"};  ///< from the base on
  std::string end_effector = "end_effector", imu = "imu";                  ///< frames

  /// Those that move against each other: all but the frames.
  std::vector<std::string> bodies() const;
  std::vector<std::string> all() const;

  /// A reader refuses a name that stands for two.
  void describe(ConfigVisitor& v);
};

}  // namespace ballbot
