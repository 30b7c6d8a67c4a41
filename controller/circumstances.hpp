#pragma once

#include "controller/lasting_forces.hpp"
#include "model/limits.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

/// What a plan counts on beside the robot's state and its tasks: what is known of the world at its
/// end-effector and under its ball, and of its own wheels.
struct Circumstances {
  Vector3 contact_force_W = Vector3::Zero();  ///< environment on the end-effector, measured [N]
  /// Torque with which the floor holds the ball's spin about the vertical; kUnlimited without end
  /// [N m].
  double floor_held = kUnlimited;
  WheelFlags lost_wheels{};  ///< whose torque moves nothing
  /// A force on the robot that acts now, in the rows of nu, and the time over which it fades.
  VelocityVector push = VelocityVector::Zero();  ///< [N, N m]
  double push_lasts = 1;                         ///< [s]
  LastingForces lasting;                         ///< that the model does not know of
};

}  // namespace ballbot
