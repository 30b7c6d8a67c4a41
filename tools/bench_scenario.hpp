#pragma once

#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "experiment/scenario.hpp"
#include "hil/bench_config.hpp"

namespace ballbot {

/// A bench file with `--set` overrides applied. @throw InputError
ConfigNode loadBenchTree(const std::string& path, const std::vector<std::string>& overrides);

/// Path of the scenario a bench file names. @throw InputError if it names none.
std::string benchScenarioPath(const BenchConfig& bench, const std::string& bench_path);

/// The scenario a bench file names, relative to the file, with the overrides it lists. Controller
/// and bench must agree on it. @throw InputError if it names none.
Scenario loadBenchScenario(const BenchConfig& bench, const std::string& bench_path);

}  // namespace ballbot
