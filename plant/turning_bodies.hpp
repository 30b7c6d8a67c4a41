#pragma once

// Includes Simbody, as robot_tree.hpp does.
#include "plant/robot_tree.hpp"

namespace ballbot {

/// Wheels and rotors as bodies of their own, for structures that have them. The full structure
/// makes its own: compiled elsewhere their inertias round otherwise in the last bit, and with them
/// every digest of a run.
///
/// A rotor's mass and transverse inertia are part of the body that carries it: they are taken out
/// of it here, so that a robot with its rotors locked is the robot it was.

/// `body` without the rotors that it carries.
BodyInertia withoutRotors(const BodyInertia& body, BodyIndex index, const RobotParameters& robot,
                          const MultibodyOptions& options);
/// The same for the arm's links, the last one with its payload.
std::array<BodyInertia, kArmJointCount> linksWithoutRotors(const RobotParameters& robot,
                                                           const MultibodyOptions& options);

SimTK::MobilizedBody addWheel(SimTK::MobilizedBody& base, const RobotParameters& robot, int wheel);
/// A pin whose coordinate is the rotor's own angle, gear ratio times the angle behind the gear.
SimTK::MobilizedBody addRotor(SimTK::MobilizedBody& carrier, const ActuatorMount& mount,
                              double axial_inertia);

}  // namespace ballbot
