#pragma once

#include <string>
#include <vector>

#include "fmi/coupling_graph.hpp"
#include "fmi/fmu_description.hpp"
#include "fmi/fmu_process.hpp"

namespace ballbot {

// The participants of a coupling, as connections see them.

/// Commands follow from sensors at once: the controller is part of every loop.
CouplingNode controllerNode();
CouplingNode recordNode();
CouplingNode nativePlantNode();

/// One FMU of the scenario, as far as connections use it.
struct UsedFmu {
  FmuEntry entry;
  FmuDescription description;
};

/// The FMU with those of its ports that `lines` use, which are put into `use`, too.
/// @throw InputError if it has no such port, or none that can be connected so.
CouplingNode fmuNode(const UsedFmu& fmu, const std::vector<CouplingLine>& lines, FmuUse& use);

/// "door.hand[2]" is the port "hand[2]" of "door".
bool belongsTo(const std::string& end, const std::string& node);
std::string portOf(const std::string& end);

}  // namespace ballbot
