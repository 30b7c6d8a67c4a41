#pragma once

#include <string>

#include "model/added_signals.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Empty if every number is finite, else the first that is not: "torque_wheel2 is nan".
std::string firstNonFinite(const ActuatorCommand& command);

std::string firstNonFinite(const AddedSignals& signals);

/// Empty if a robot could be so at `now`, else what it cannot be, by name:
/// "sensors.motor_angle_wheel2 is 1e+308 rad, beyond 1e+06", "sensors.imu_time is 3601 s, at 1 s".
/// Counts are not negative, no time is ahead of `now` by more than a bench's skipped periods, and
/// no number is so large that only a fault, or a stranger, can have sent it.
std::string firstImpossible(const SensorFrame& sensors, SimTime now);
std::string firstImpossible(const TruthFrame& truth, SimTime now);

}  // namespace ballbot
