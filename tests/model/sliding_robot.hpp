#pragma once

#include "model/robot_parameters.hpp"

namespace ballbot {

/// The same robot with an arm whose second joint slides, askew.
inline RobotParameters withASlide(RobotParameters robot) {
  ArmLink& link = robot.arm[1];
  link.lead = 0.15;
  link.axis = Vector3(0.3, -0.2, 1).normalized();
  return robot;
}

}  // namespace ballbot
