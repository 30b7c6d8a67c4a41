#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// A sphere of a link's <collision>.
struct UrdfSphere {
  int line = 0;
  Vector3 p_LS = Vector3::Zero();  ///< its centre in the link [m]
  double radius = 0;               ///< [m]
};

struct UrdfLink {
  int line = 0;
  std::string name;
  std::optional<BodyInertia> inertial;
  std::vector<UrdfSphere> spheres;
};

enum class UrdfJointType { kRevolute, kContinuous, kPrismatic, kFixed, kFloating, kPlanar };
const char* toText(UrdfJointType type);

/// What a URDF says of the drive at a joint, where it says something. A limit beyond kUnlimited or
/// of zero, which exporters write where nobody told them one, and a friction of zero, which is the
/// format's default, say nothing.
struct UrdfDrive {
  std::string where;                            ///< "<file>:<line>: joint 'x'"
  std::optional<double> effort, velocity;       ///< limits [N m, rad/s]
  std::optional<double> damping, dry_friction;  ///< [N m s/rad, N m]
};

struct UrdfJoint {
  int line = 0;
  std::string name, parent, child;
  UrdfJointType type = UrdfJointType::kFixed;
  Eigen::Isometry3d X_PC = Eigen::Isometry3d::Identity();  ///< child's frame, at zero, in parent's
  Vector3 axis = Vector3::UnitX();  ///< unit vector in the child's frame, of a joint that turns
  double lower_limit = 0, upper_limit = 0;  ///< [rad]; -+kUnlimited where there is none
  UrdfDrive drive;
};

/// The links and joints of a URDF in the order of the file, each well written by itself. Whether
/// they make a tree, and a robot of this kind, is for others to see.
struct UrdfDescription {
  std::string file, name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
};

/// Reads the part of URDF that is mechanics. Visuals, meshes, materials, transmissions, sensors and
/// extensions such as <gazebo> are left to others. What would change the motion and is not
/// simulated (mimic, soft limits) is refused at joints that move.
/// @param file  where `text` stands, for messages
/// @throw InputError "<file>:<line>: ..."
UrdfDescription readUrdf(const std::string& file, const std::string& text);

}  // namespace ballbot
