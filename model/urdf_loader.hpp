#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/robot_links.hpp"
#include "model/urdf_description.hpp"

namespace ballbot {

/// Where nobody says another one: a pinion of 20 mm radius [m/rad].
constexpr double kSlideLead = 0.02;

/// What a URDF says about a robot of this kind. Fields of `parameters` that a URDF cannot hold
/// (gravity, wheel geometry, limits of the controller) keep their defaults.
struct UrdfRobot {
  RobotParameters parameters;
  std::array<Vector3, kWheelCount> wheel_centre;  ///< from K, in B [m]
  std::array<Vector3, kWheelCount> wheel_axle;    ///< unit vectors, in B
  std::array<UrdfDrive, kJointCount> drives;
  std::array<std::string, kJointCount> joints;  ///< their names
  double slide_lead = 0;                        ///< of those that slide [m/rad]
  std::vector<std::string> notes;               ///< what is allowed and most likely not meant
};

/// Reads a robot with these links: base (the root, origin at the ball's centre), ball, wheels, arm,
/// end-effector and IMU. Every other link must hang on a fixed joint; its mass, and that of
/// end-effector and IMU, counts to the body it is fixed to. Frames may be turned as the file likes:
/// those of `parameters` are parallel to the base's at zero angles. The ball's radius is that of
/// its collision sphere. The same text in the same file is parsed once in a process.
/// docs/robot.md says more.
/// @throw InputError naming file, line and link or joint.
/// @param lead  of the drives of joints that slide, whose limits the file has in m [m/rad]
UrdfRobot loadUrdf(const std::string& path, const RobotLinks& links = {}, double lead = kSlideLead);

}  // namespace ballbot
