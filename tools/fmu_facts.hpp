#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "fmi/fmu_description.hpp"

namespace ballbot {

/// What an FMU says of itself, for people and for programs.
std::string fmuFactsText(const FmuDescription& fmu);
nlohmann::ordered_json fmuFactsJson(const FmuDescription& fmu);

}  // namespace ballbot
