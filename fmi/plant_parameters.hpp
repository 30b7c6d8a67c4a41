#pragma once

#include <string>
#include <vector>

#include "fmi/variables.hpp"

namespace ballbot {

/// A value of the scenario that an FMU's user may change before initialisation.
struct PlantParameter {
  std::string path;  ///< in the scenario, and the variable's name
  VariableType type = VariableType::kReal;
  std::string unit;
  std::string description;
  double fallback = 0;  ///< where the scenario does not say; as the plant's own reader has it
  std::vector<std::string> choices;  ///< of an enumeration, numbered from 1
  std::string otherwise;             ///< path whose value stands in where the scenario lacks `path`
};

const std::vector<PlantParameter>& plantParameters();

/// Its value in a scenario; booleans as 0 and 1. @throw InputError with file, line and column.
double parameterValue(const PlantParameter& parameter, const ConfigNode& scenario);

/// Writes a value into a scenario. Whether it is good is judged by whoever reads the scenario.
/// @throw InputError if it is no value of the parameter's type.
void setParameter(const PlantParameter& parameter, double value, ConfigNode& scenario);

}  // namespace ballbot
