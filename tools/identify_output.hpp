#pragma once

#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/identify/configuration.hpp"

namespace ballbot {

/// Where what was identified is written, "" for nowhere.
struct IdentifyFiles {
  std::string scenario, actuator, bench, figure;
};

/// The scenario that what is found will change.
struct ScenarioToChange {
  std::string path;
  Configured configured;
  bool mpc = false;  ///< it has one, whose frequency shaping can be matched
};

/// @param path  of the scenario; "": the bench file's, with the overrides listed there
ScenarioToChange scenarioToChange(const std::string& path, const BenchConfig& bench,
                                  const std::string& bench_path, int drive);

/// Writes the files asked for, each with paths as seen from itself.
/// @param bench_tree  the bench file as read
/// @throw OutputError
void writeIdentified(const Identification& found, const IdentifyFiles& files,
                     const ScenarioToChange& scenario, const BenchConfig& bench,
                     const ConfigNode& bench_tree, const std::string& bench_path, int drive);

}  // namespace ballbot
