#pragma once

#include "controller/governed_orientation.hpp"

namespace ballbot {

/// Every command of a task, as the plan of one instant takes it.
struct GovernedCommands {
  GovernedCommand<3> ee_position;  ///< [m]
  GovernedOrientation ee_orientation;
  GovernedCommand<2> ball_position;  ///< [m]
  GovernedCommand<1> yaw;            ///< [rad]
  GovernedCommand<3> arm_position;   ///< [rad]
  /// The longest force that the end-effector is asked to push with [N].
  double push = std::numeric_limits<double>::infinity();
};

}  // namespace ballbot
