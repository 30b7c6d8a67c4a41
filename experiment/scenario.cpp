#include "experiment/scenario.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/config_listing.hpp"
#include "core/config_values.hpp"
#include "core/config_visitor.hpp"
#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/yaml_file.hpp"
#include "cosim/recorder.hpp"
#include "experiment/scenario_variants.hpp"
#include "experiment/text_file.hpp"
#include "fmi/coupling_config.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

std::vector<MetricLimit> readRequirements(const ConfigNode& node) {
  if (node.kind() != ConfigNode::Kind::kMap) {
    throw InputError(
        fmt::format("{}: requirements must be a mapping from metric to limits, e.g. "
                    "'largest_tilt_deg: {{below: 20}}'",
                    toText(node.where())));
  }
  std::vector<MetricLimit> out;
  for (const auto& [metric, limits] : node.entries()) {
    ConfigReader in(limits, "requirements." + metric);
    MetricLimit r;
    r.metric = metric;
    r.where = limits.where();
    if (in.has("below")) r.below = in.number("below");
    if (in.has("above")) r.above = in.number("above");
    in.finish();
    if (!r.below && !r.above) {
      throw InputError(
          fmt::format("{}: requirement '{}' has no limit; give 'below', 'above' or both",
                      toText(limits.where()), metric));
    }
    out.push_back(std::move(r));
  }
  return out;
}

/// The URDF named in the robot section. @throw InputError if there is no such file.
std::string requireUrdf(const ConfigNode& robot) {
  const ConfigNode* urdf = robot.find("urdf");
  if (!urdf || urdf->kind() != ConfigNode::Kind::kScalar) {
    throw InputError(
        fmt::format("{}: key 'urdf' (a file name) is missing in 'robot'", toText(robot.where())));
  }
  const std::string path = urdfPath(*urdf);
  if (!fs::is_regular_file(path)) {
    throw InputError(fmt::format("{}: urdf is '{}', but there is no file '{}'",
                                 toText(urdf->where()), urdf->text(), path));
  }
  return path;
}

constexpr const char* kSections[] = {"robot",     "plant",      "initial",   "environment",
                                     "estimator", "controller", "recording", "fmus"};

}  // namespace

void Rates::describe(ConfigVisitor& v) {
  v.duration(may("base_step_us", "of which every period is a whole multiple"), base_step, {1, 1e6});
  v.duration(may("tracker_period_us", "from one command to the drives to the next"), tracker,
             {1, 1e6});
  v.duration(may("estimator_period_us", "from one state estimate to the next"), estimator,
             {1, 1e6});
  v.duration(may("planner_period_us", "from one plan to the next"), planner, {1, 1e7});
  v.duration(may("plan_latency_us", "age of a plan when it comes into force"), plan_latency,
             {0, 1e6});
}

void Scenario::describe(ConfigVisitor& v) {
  v.fileName(must("name", "of the run's folder"), name);
  v.text(may("summary", "a line for people"), summary);
  v.duration(must("duration_s", "simulated time"), duration, {1e-3, 1e5});
  describeSeed(v, seed);
}

const ConfigNode& Scenario::section(const std::string& section_name) const {
  const ConfigNode* node = tree.find(section_name);
  if (!node) {
    throw InputError(
        fmt::format("{}: section '{}' is missing", toText(tree.where()), section_name));
  }
  return *node;
}

std::string Scenario::configDigest() const {
  ConfigNode canonical = tree;
  canonical.find("robot")->set("urdf", ConfigNode::scalar("robot.urdf", false, {}));
  redirectFmus(canonical, [](const FmuEntry& fmu) { return fmu.name; });
  Digest digest;
  digest.add(toYaml(canonical));
  digest.add(readTextFile(urdf_path));
  for (const FmuEntry& fmu : readFmus(tree)) digest.add(readTextFile(fmu.file));
  return digest.hex();
}

ConfigNode loadScenarioTree(const std::string& path) {
  if (fs::is_directory(path)) {
    throw InputError(
        fmt::format("{}: is a folder; a scenario is a YAML file such as "
                    "configs/scenarios/balance.yaml",
                    path));
  }
  ConfigNode tree = loadYamlFile(path);
  if (tree.kind() != ConfigNode::Kind::kMap) {
    throw InputError(fmt::format("{}: a scenario must be a mapping of keys to values", path));
  }
  return tree;
}

Scenario loadScenario(const std::string& path, const std::vector<std::string>& overrides,
                      std::optional<std::uint64_t> seed) {
  return readScenario(loadScenarioTree(path), overrides, seed);
}

Scenario readScenario(ConfigNode tree, const std::vector<std::string>& overrides,
                      std::optional<std::uint64_t> seed) {
  Scenario s;
  s.tree = std::move(tree);
  for (const std::string& text : overrides) applyOverride(s.tree, text);
  if (seed) {
    s.tree.set("seed", ConfigNode::scalar(std::to_string(*seed), false, {"--seed", 0, 0}));
  }

  ConfigReader in(s.tree);
  readDescribed(in, s);
  for (const char* section : kSections) in.raw(section);
  if (in.has("rates")) {
    ConfigReader rates = in.child("rates");
    readDescribed(rates, s.rates);
    rates.finish();
  }
  if (const ConfigNode* node = in.raw("requirements")) s.requirements = readRequirements(*node);
  in.finish();

  s.section("plant");
  s.section("estimator");
  s.section("controller");
  if (const ConfigNode* initial = s.tree.find("initial")) {
    ConfigReader initial_in(*initial, "initial");  // the plant reads, and finishes, the rest of it
    s.release = kSimStart + initial_in.durationOr("release_s", SimDuration::zero(), {0, 100});
  }
  s.urdf_path = requireUrdf(s.section("robot"));
  return s;
}

void recordNothing(Scenario& scenario) {
  ConfigNode recording = ConfigNode::map({});
  ConfigListing listing;
  RecorderOptions().describe(listing);
  for (const KeyEntry& key : listing.take()) {
    recording.set(key.path, ConfigNode::scalar("-1", false, {}));
  }
  scenario.tree.set("recording", recording);
}

void writeScenario(const Scenario& scenario, const std::string& folder) {
  ConfigNode tree = scenario.tree;
  tree.find("robot")->set("urdf", ConfigNode::scalar("robot.urdf", false, {}));
  redirectFmus(tree, [&](const FmuEntry& fmu) {
    fs::create_directories(folder + "/fmus");
    const std::string file = "fmus/" + fmu.name + ".fmu";
    writeTextFile(folder + "/" + file, readTextFile(fmu.file));
    return file;
  });
  writeTextFile(folder + "/scenario.yaml",
                "# What was run: includes and overrides resolved. Run it again with\n"
                "#   ballbot run scenario.yaml\n" +
                    toYaml(tree));
  writeTextFile(folder + "/robot.urdf", readTextFile(scenario.urdf_path));
}

}  // namespace ballbot
