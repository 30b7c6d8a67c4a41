#pragma once

#include "experiment/scenario.hpp"

namespace ballbot {

// For those who make many scenarios of one file, such as studies.

/// What the file says, includes followed. @throw InputError as loadScenario
ConfigNode loadScenarioTree(const std::string& path);

/// A scenario of it: loadScenario(path, ...) is readScenario(loadScenarioTree(path), ...).
Scenario readScenario(ConfigNode tree, const std::vector<std::string>& overrides = {},
                      std::optional<std::uint64_t> seed = std::nullopt);

/// Reads all of a scenario as its run would, without running it.
/// @return every metric that its run can have
/// @throw InputError with file, line and column.
std::vector<std::string> checkScenario(const Scenario& scenario);

/// Records nothing in the scenario's log but what every log has. The run stays the same.
void recordNothing(Scenario& scenario);

}  // namespace ballbot
