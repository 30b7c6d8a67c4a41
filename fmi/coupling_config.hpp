#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "core/config_node.hpp"

namespace ballbot {

/// One line `{from: door.force, to: plant.force.end_effector_W}` of a scenario.
struct CouplingLine {
  std::string from, to;
  bool delayed = false;  ///< carries the value of one communication step before
  SourceLocation where;
};

/// The entry named so stands in the plant's place.
constexpr const char* kPlantName = "plant";
/// What the controller sends and receives, and what goes on record, in connections.
constexpr const char* kControllerName = "controller";
constexpr const char* kRecordName = "record";

/// One entry of a scenario's `fmus:`.
struct FmuEntry {
  std::string name, file;
  std::map<std::string, double> parameters;  ///< booleans as 0 and 1, enumerations by number
  std::vector<CouplingLine> lines;
  std::chrono::milliseconds patience{10'000};  ///< with one call, before it counts as lost
  SourceLocation where;
};

/// All FMUs of a scenario, in the order they are stepped in; none without the section.
/// @throw InputError with file, line and column.
std::vector<FmuEntry> readFmus(const ConfigNode& scenario);

/// Points the scenario's FMUs to other files: new_file(name, present path).
template <typename NewFile>
void redirectFmus(ConfigNode& scenario, NewFile&& new_file) {
  ConfigNode* fmus = scenario.find("fmus");
  if (!fmus) return;
  const std::vector<FmuEntry> entries = readFmus(scenario);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    fmus->items()[i].set("file", ConfigNode::scalar(new_file(entries[i]), false, {}));
  }
}

}  // namespace ballbot
