#pragma once

#include <string>

#include "plant/plant_config.hpp"

namespace ballbot {

/// What decides which numbers a saved state of a plant holds, in words.
std::string plantStateForm(const PlantConfig& config);

}  // namespace ballbot
