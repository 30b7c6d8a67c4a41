#include "tools/identify_output.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "experiment/run_config.hpp"
#include "experiment/text_file.hpp"
#include "hil/identify/bode_figure.hpp"
#include "tools/bench_scenario.hpp"

namespace ballbot {
namespace {

/// A file as another one names it.
std::string seenFrom(const std::string& file, const std::string& other) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(other).parent_path();
  return fs::absolute(file).lexically_normal().lexically_relative(folder).string();
}

void writeSaying(const std::string& path, const std::string& text) {
  writeTextFile(path, text);
  fmt::print(stderr, "identify: wrote {}\n", path);
}

/// The bench file with this drive's response as found.
std::string benchYaml(const Identification& found, const std::string& include,
                      const ConfigNode& bench_tree, int drive, const std::string& name) {
  ConfigNode drives = *bench_tree.find("drives");
  ConfigNode& entry = drives.items().at(static_cast<std::size_t>(drive));
  const auto set = [&](const char* key, double value) {
    entry.set(key, ConfigNode::scalar(fmt::format("{:.5g}", value), false, {}));
  };
  const TorqueResponse& r = found.second;
  set("torque_frequency_Hz", r.natural_frequency / kTwoPi);
  set("torque_damping_ratio", r.damping_ratio);
  set("torque_delay_ms", 1e3 * std::max(0.0, r.delay));
  ConfigNode tree = ConfigNode::map({});
  tree.set("drives", drives);
  return fmt::format(
      "# {}: torque response as identified, second order: {:.2f} +- {:.2f} Hz, damping {:.3f} +- "
      "{:.3f},\n# delay {:.3f} +- {:.3f} ms; rms error {:.4f}\ninclude: {}\n{}",
      name, r.natural_frequency / kTwoPi, r.natural_frequency_sigma / kTwoPi, r.damping_ratio,
      r.damping_ratio_sigma, 1e3 * r.delay, 1e3 * r.delay_sigma, r.residual, include, toYaml(tree));
}

}  // namespace

ScenarioToChange scenarioToChange(const std::string& path, const BenchConfig& bench,
                                  const std::string& bench_path, int drive) {
  ScenarioToChange out;
  out.path = path.empty() ? benchScenarioPath(bench, bench_path) : path;
  const Scenario scenario =
      loadScenario(out.path, path.empty() ? bench.overrides : std::vector<std::string>{});
  const RunConfig config = readRunConfig(scenario);
  const PlantConfig& plant = config.plant.plant;
  const DriveConfig& d = bench.drives[static_cast<std::size_t>(drive)];
  out.configured = {plant.actuators.of(drive),   toSeconds(plant.drive_period),
                    plant.transport_delay_ticks, d.torque_delay,
                    d.torque_frequency_Hz,       d.torque_damping_ratio};
  out.mpc = config.controller.law->shapesWheelTorques();
  if (!out.mpc) {
    fmt::print(stderr,
               "identify: {} has no MPC whose frequency shaping could be matched; --scenario names "
               "another one\n",
               out.path);
  }
  return out;
}

void writeIdentified(const Identification& found, const IdentifyFiles& files,
                     const ScenarioToChange& scenario, const BenchConfig& bench,
                     const ConfigNode& bench_tree, const std::string& bench_path, int drive) {
  const bool wheel = drive < kWheelCount;
  ScenarioNames names;
  names.drive = bench.drives[static_cast<std::size_t>(drive)].name;
  names.group = wheel ? "wheel" : "arm";
  names.shaping = scenario.mpc && wheel;
  if (!files.actuator.empty()) {
    writeSaying(files.actuator, actuatorYaml(found, scenario.configured, names.drive));
  }
  if (!files.scenario.empty()) {
    names.include = seenFrom(scenario.path, files.scenario);
    if (!files.actuator.empty()) names.actuator_file = seenFrom(files.actuator, files.scenario);
    writeSaying(files.scenario, scenarioYaml(found, scenario.configured, names));
  }
  if (!files.bench.empty()) {
    writeSaying(files.bench, benchYaml(found, seenFrom(bench_path, files.bench), bench_tree, drive,
                                       names.drive));
  }
  if (!files.figure.empty()) {
    writeSaying(files.figure, bodeSvg(names.drive, found, bench.cycleSeconds()));
  }
}

}  // namespace ballbot
