#pragma once

#include <memory>

#include "controller/control_law.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;

/// Makes the balancing law that `kind` names, from the mapping of the same name beside it:
///
///     kind: lqr        # | mpc | decoupled
///     lqr: {...}
///
/// Reads these two keys of `in` and leaves the rest, and finish(), to the caller. Mappings of other
/// kinds are passed over, so that one file can hold several laws to choose from.
/// @throw InputError for what cannot be read or cannot be balanced.
std::unique_ptr<ControlLaw> makeControlLaw(ConfigReader& in, const RobotParameters& robot);

}  // namespace ballbot
