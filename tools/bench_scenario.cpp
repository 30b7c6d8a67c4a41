#include "tools/bench_scenario.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {

ConfigNode loadBenchTree(const std::string& path, const std::vector<std::string>& overrides) {
  ConfigNode tree = loadYamlFile(path);
  for (const std::string& text : overrides) applyOverride(tree, text);
  return tree;
}

std::string benchScenarioPath(const BenchConfig& bench, const std::string& bench_path) {
  if (bench.scenario_path.empty()) {
    throw InputError(bench_path +
                     ": names no scenario; add e.g. scenario: ../scenarios/balance.yaml");
  }
  const std::filesystem::path file = bench.scenario_path;
  const auto beside = std::filesystem::path(bench_path).parent_path() / file;
  return file.is_absolute() ? file.string() : beside.string();
}

Scenario loadBenchScenario(const BenchConfig& bench, const std::string& bench_path) {
  return loadScenario(benchScenarioPath(bench, bench_path), bench.overrides);
}

}  // namespace ballbot
