#pragma once

#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// What holds over poses of the arm that cover what its joints reach.
struct Workspace {
  int poses = 0;
  int unbalanced = 0;  ///< in which the robot cannot stand within 30 degrees

  // Of the others:
  double largest_tilt = 0;                            ///< of the base at rest [rad]
  ArmVector most_tilted_arm = ArmVector::Zero();      ///< where that is [rad]
  double least_fall_rate = 0, largest_fall_rate = 0;  ///< fastest unstable poles [1/s]
  ArmVector largest_arm_torque = ArmVector::Zero();   ///< to hold still, of each joint [N m]

  // Of the end-effector from the ball's centre, the robot standing:
  double least_reach = 0, largest_reach = 0;    ///< in the plane [m]
  double least_height = 0, largest_height = 0;  ///< above the floor [m]
};

/// @param steps  poses of each joint, evenly from limit to limit; one that is unlimited goes
/// around.
///               Fewer for an arm of so many joints that they would be too many together
Workspace surveyWorkspace(const ReducedDynamics& dynamics, int steps);

/// The largest real part of the poles at rest [1/s].
double fallRate(const ReducedDynamics& dynamics, const Equilibrium& rest);

}  // namespace ballbot
