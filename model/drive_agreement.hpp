#pragma once

#include "model/robot_reader.hpp"
#include "model/urdf_loader.hpp"

namespace ballbot {

/// What the URDF says of the drives against the `actuators:` of the `robot:` section, which are
/// what is simulated: these must keep the URDF's limits (effort, velocity), and have its damping
/// and friction.
/// @throw InputError naming both places.
void checkDriveAgreement(const UrdfRobot& urdf, const RobotActuators& actuators,
                         ConfigReader& robot);

}  // namespace ballbot
