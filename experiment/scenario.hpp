#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "core/time.hpp"

namespace ballbot {

class ConfigVisitor;

/// How often each part of the controller runs, and how old its plans are when they act.
struct Rates {
  SimDuration tracker = std::chrono::microseconds(400);
  SimDuration estimator = std::chrono::microseconds(2500);
  SimDuration planner = std::chrono::milliseconds(14);
  SimDuration plan_latency = SimDuration::zero();
  SimDuration base_step = std::chrono::microseconds(100);  ///< every period is a multiple of it

  void describe(ConfigVisitor& v);
};

/// One line of a scenario's `requirements`: a metric and what it must stay below or above.
struct MetricLimit {
  std::string metric;
  std::optional<double> below, above;
  SourceLocation where;
};

/// What to simulate, for how long, and what counts as success. Sections that belong to one part
/// (robot, plant, estimator, controller, ...) stay in `tree` and are read by that part.
struct Scenario {
  std::string name;
  std::string summary;
  SimDuration duration{};
  std::uint64_t seed = 1;
  SimTime release{};  ///< until then a stand holds the robot still
  Rates rates;
  std::vector<MetricLimit> requirements;
  ConfigNode tree = ConfigNode::map({});
  std::string urdf_path;

  /// Tells of what stands in no section: name, summary, duration, seed.
  void describe(ConfigVisitor& v);

  /// The section `name`. @throw InputError if it is missing.
  const ConfigNode& section(const std::string& name) const;

  /// Digest of everything that decides the course of a run: the effective configuration and the
  /// bytes of the URDF and of FMUs. Two processes of a run must agree on it.
  std::string configDigest() const;
};

/// Reads a scenario file, follows its includes, applies `--set` overrides in order, and checks all
/// that is not left to the parts.
/// @throw InputError with file, line and column.
Scenario loadScenario(const std::string& path, const std::vector<std::string>& overrides = {},
                      std::optional<std::uint64_t> seed = std::nullopt);

/// Writes `scenario.yaml`, `robot.urdf` and the FMUs, if there are any, into `folder`: with
/// includes and overrides resolved, so that the folder alone says what was run.
/// loadScenario(folder/scenario.yaml) gives the same.
/// @throw OutputError
void writeScenario(const Scenario& scenario, const std::string& folder);

}  // namespace ballbot
