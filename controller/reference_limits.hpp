#pragma once

#include <string>

#include "controller/constraints.hpp"
#include "controller/tasks.hpp"

namespace ballbot {

class ConfigReader;

/// Refuses references that the robot cannot follow whatever it does: an arm pose beyond a joint's
/// limits, or one at which a torque limit is below what standing still takes; a contact force that
/// pulls, or leaves its friction cone.
/// @param tasks  for the words of errors: where the references were read
/// @throw InputError; NumericalError if an arm pose cannot be balanced.
void requireWithinLimits(const TaskSchedule& schedule, const Constraints& constraints,
                         const RobotParameters& robot, const ConfigReader& tasks);

/// Standing still with the arm at `arm` [rad] must take less than the limits [N m].
/// @param where  begins the error
/// @throw InputError, NumericalError as above
void requireStaticTorque(const RobotParameters& robot, const ArmVector& arm,
                         const JointVector& torque_limit, const std::string& where);

}  // namespace ballbot
