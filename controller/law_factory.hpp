#pragma once

#include <memory>

#include "controller/control_law.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// Makes the balancing law that `kind` names, from the mapping of the same name beside it:
///
///     kind: lqr        # | mpc | decoupled
///     lqr: {...}
///
/// Reads these two keys of `in` and leaves the rest, and finish(), to the caller. Mappings of other
/// kinds are passed over, so that one file can hold several laws to choose from.
/// @throw InputError for what cannot be read or cannot be balanced.
std::unique_ptr<ControlLaw> makeControlLaw(ConfigReader& in, const RobotParameters& robot);

/// The key of the `controller:` section that says which payload estimator and law count on [kg].
void describeKnownPayload(ConfigVisitor& v, double& payload);

/// Tells of the whole `controller:` section, of every law and of what others read from it: its
/// keys, and what they mean where the file says nothing.
/// @throw NumericalError if the robot's nominal pose has no equilibrium.
void describeController(ConfigVisitor& v, const RobotParameters& robot);

}  // namespace ballbot
