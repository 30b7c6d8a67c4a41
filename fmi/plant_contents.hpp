#pragma once

#include "core/config_node.hpp"
#include "fmi/coupling_config.hpp"
#include "fmi/fmu_description.hpp"

namespace ballbot {

/// Sections of a scenario that the plant is made from; an FMU that stands in its place replaces
/// them all.
constexpr const char* kPlantSections[] = {"seed", "robot", "plant", "initial", "environment"};

/// An FMU in the plant's place is the plant of the scenario, or the run would say one thing and do
/// another, e.g. pass a test of pushes without a push. This program's FMUs carry their scenario,
/// and its digest as GUID or token: with the entry's parameters, it must have the same plant.
/// Nobody can look into others; with them the scenario has neither environment nor faults.
/// @throw InputError naming what differs
void requireSamePlant(const ConfigNode& scenario, const FmuEntry& entry,
                      const FmuDescription& description);

}  // namespace ballbot
