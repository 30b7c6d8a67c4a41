#pragma once

#include "solver/frequency_shaping.hpp"
#include "solver/horizon.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

// The solver's settings as configuration files have them; solver/ knows of none.

void describe(ConfigVisitor& v, Horizon& horizon);
/// Lengths must be whole multiples of their steps.
/// @param in  where they were read, for the error's words
/// @throw InputError
void requireWholeSteps(const ConfigReader& in, const Horizon& horizon);

/// Either zero_rad_per_s and pole_rad_per_s, or actuator_bandwidth_Hz, or enabled: false.
void describe(ConfigVisitor& v, FrequencyShaping& shaping);

}  // namespace ballbot
