#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/scenario.hpp"
#include "fmi/fmu_export.hpp"
#include "fmi/fmu_process.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/fmu_facts.hpp"

namespace ballbot {
namespace {

struct FmuArguments {
  std::string scenario, out, info;
  std::vector<std::string> overrides;
  int fmi_version = 2;
  bool json = false;
};

ExitCode exportPlant(const FmuArguments& arguments) {
  const Scenario scenario = loadScenario(arguments.scenario, arguments.overrides);
  FmuExport how;
  how.fmi_version = arguments.fmi_version;
  how.program_version = BALLBOT_VERSION;
  how.libraries_folder = defaultFmuLibraries();
  exportFmu(scenario.tree, scenario.urdf_path, how, arguments.out);
  if (arguments.json) {
    const nlohmann::ordered_json made{{"file", arguments.out},
                                      {"fmi_version", arguments.fmi_version}};
    fmt::print("{}\n", jsonText(made));
  } else {
    fmt::print("{}\n", arguments.out);
  }
  return ExitCode::kPassed;
}

ExitCode showFmu(const FmuArguments& arguments) {
  const FmuDescription fmu = readFmuDescription(arguments.info);
  if (arguments.json) {
    fmt::print("{}\n", jsonText(fmuFactsJson(fmu)));
  } else {
    fmt::print("{}", fmuFactsText(fmu));
  }
  return ExitCode::kPassed;
}

/// The process of one FMU of a run. No verb for people: it has no line in --help.
void addFmuServeCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command =
      program.add_subcommand(kFmuServeVerb, "The process of an FMU; started by run");
  command->group("");
  const auto socket = std::make_shared<int>(-1);
  command->add_option("--socket", *socket)->required();
  command->callback([&result, socket] { result = static_cast<ExitCode>(serveFmu(*socket)); });
}

}  // namespace

void addFmuCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "fmu", "Export a scenario's plant as an FMU for Co-Simulation, or say what an FMU is");
  const auto a = std::make_shared<FmuArguments>();
  CLI::Option* scenario =
      command->add_option("--scenario", a->scenario, "Scenario whose plant is exported");
  CLI::Option* out =
      command->add_option("-o,--out", a->out, "FMU to write, e.g. ballbot_plant.fmu");
  command->add_option("--fmi", a->fmi_version, "Version of FMI to export for")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  command->add_option("--set", a->overrides, "path=value, as for run")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  CLI::Option* info = command->add_option(
      "--info", a->info, "Say what is in this FMU, whoever made it: capabilities and variables");
  command->add_flag("--json", a->json, "Print as JSON");
  scenario->needs(out)->excludes(info);
  out->needs(scenario)->excludes(info);
  command->footer(
      "Examples:\n"
      "  ballbot fmu --fmi 3 --scenario configs/scenarios/balance.yaml -o ballbot_plant.fmu\n"
      "  ballbot fmu --info ballbot_plant.fmu\n"
      "What the variables mean, and how to use FMUs in a scenario: docs/fmu.md.\n"
      "Exit codes: 0 done, 2 bad input, 4 the FMU could not be written.");
  command->callback([&result, a] {
    if (a->info.empty() && a->scenario.empty()) {
      throw InputError("fmu: give --scenario and -o to export a plant, or --info and an FMU");
    }
    result = a->info.empty() ? exportPlant(*a) : showFmu(*a);
  });
  addFmuServeCommand(program, result);
}

}  // namespace ballbot
