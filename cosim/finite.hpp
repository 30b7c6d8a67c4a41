#pragma once

#include <string>

#include "model/signals.hpp"

namespace ballbot {

/// Empty if every number is finite, else the first that is not: "torque of wheel 2 is nan".
std::string firstNonFinite(const ActuatorCommand& command);
std::string firstNonFinite(const SensorFrame& sensors);

}  // namespace ballbot
