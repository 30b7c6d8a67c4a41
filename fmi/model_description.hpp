#pragma once

#include <string>

#include "fmi/variables.hpp"

namespace ballbot {

/// What a model description says besides its variables.
struct ModelFacts {
  std::string token;        ///< GUID or instantiation token, see fmuToken()
  std::string version;      ///< of this program
  std::string description;  ///< of the scenario
  double stop_time_s = 0;   ///< of the default experiment
  double internal_step_s = 0;
};

/// The shared object's name and the model identifier.
constexpr const char* kModelIdentifier = "ballbot_plant";

/// modelDescription.xml of FMI 2.0: arrays element by element, enumerations as integers.
/// @throw InputError if a value does not fit FMI 2's 32-bit integers.
std::string fmi2ModelDescription(const FmuVariables& variables, const ModelFacts& facts);

/// modelDescription.xml of FMI 3.0.
std::string fmi3ModelDescription(const FmuVariables& variables, const ModelFacts& facts);

}  // namespace ballbot
