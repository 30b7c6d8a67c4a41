#pragma once

#include <array>
#include <string>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// What a URDF says about a robot of this kind. Fields of `parameters` that a URDF cannot hold
/// (gravity, wheel geometry, limits of the controller) keep their defaults.
struct UrdfRobot {
  RobotParameters parameters;
  std::array<Vector3, kWheelCount> wheel_centre;  ///< from K, in B [m]
  std::array<Vector3, kWheelCount> wheel_axle;    ///< unit vectors, in B
};

/// Reads a robot with the links base (the root, origin at the ball's centre), ball, wheel_1 to
/// wheel_3, arm_1 to arm_3, end_effector and imu. Every other link must hang on a fixed joint; its
/// mass counts to the body it is fixed to. The ball's radius is that of its collision sphere. The
/// same text in the same file is parsed once in a process.
/// @throw InputError naming file and link: not a URDF, a missing link or inertia, a joint of an
///        unknown or unsuitable type, an inertia no rigid body can have.
UrdfRobot loadUrdf(const std::string& path);

}  // namespace ballbot
