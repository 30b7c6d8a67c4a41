#pragma once

#include <string>

#include "model/actuator_parameters.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigNode;
class ConfigReader;
class ConfigVisitor;

/// Reads the `robot:` section: the URDF it names and the rigid-body keys beside it. The keys
/// `actuators` and `sensors` of the same section are left to those who use them.
/// @throw InputError for bad keys, a bad URDF, or where the two contradict each other.
RobotParameters readRobot(ConfigReader& robot);

/// The `actuators:` of the `robot:` section; one unit for all wheels, one for all arm joints.
struct RobotActuators {
  ActuatorParameters wheel, arm;
  void describe(ConfigVisitor& v);
  const ActuatorParameters& of(int joint) const { return joint < kWheelCount ? wheel : arm; }
};
/// @throw InputError for bad keys or gains that cannot be.
RobotActuators readActuators(ConfigReader& robot);

/// The keys of the `robot:` section, but `sensors`, which are the plant's.
void describeRobot(ConfigVisitor& v);

/// The file a `urdf:` value means: relative to the file in which the value was written, or to the
/// working directory where it was given on the command line.
std::string urdfPath(const ConfigNode& urdf);

}  // namespace ballbot
