#pragma once

#include <array>

#include "controller/cost_terms.hpp"
#include "controller/governed_added.hpp"

namespace ballbot {

/// Every command of a task, as the plan of one instant takes it.
struct GovernedCommands {
  GovernedCommand<3> ee_position;  ///< [m]
  GovernedOrientation ee_orientation;
  GovernedCommand<2> ball_position;                 ///< [m]
  GovernedCommand<1> yaw;                           ///< [rad]
  GovernedCommand<kArmJointCount> arm_position;     ///< [rad]
  std::array<GovernedAdded, kMaxAddedTasks> added;  ///< in the order of the schedule's
  /// With which the arm stands still where it is: what its torques cost is counted from there
  /// [N m].
  ArmVector arm_rest_torque = ArmVector::Zero();
  /// What its barriers wish there though nothing is near, and is not granted (Constraints).
  ArmVector arm_position_wish = ArmVector::Zero(), arm_torque_wish = ArmVector::Zero();
  /// The longest force that the end-effector is asked to push with [N].
  double push = std::numeric_limits<double>::infinity();
};

}  // namespace ballbot
