#pragma once

#include "model/robot_links.hpp"
#include "model/urdf_loader.hpp"

namespace ballbot {

class ConfigNode;

/// The URDF of a `robot:` section, and what its links are called there.
struct RobotUrdf {
  RobotLinks links;
  UrdfRobot read;
};

/// @throw InputError for a URDF or names that cannot be read
RobotUrdf readRobotUrdf(const ConfigNode& robot);

}  // namespace ballbot
