#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/angle.hpp"
#include "experiment/scenario.hpp"
#include "experiment/text_file.hpp"
#include "hil/bus_budget.hpp"
#include "hil/data_sheet_check.hpp"
#include "hil/identify_drive.hpp"
#include "hil/identify_report.hpp"
#include "hil/open_can_bus.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/stepped_runner.hpp"
#include "model/actuator_response.hpp"
#include "plant/plant_config.hpp"
#include "report/json_text.hpp"
#include "tools/bench_record.hpp"
#include "tools/bench_report.hpp"
#include "tools/bench_scenario.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

struct IdentifyArguments {
  std::string config, scenario, out, figure;
  std::vector<std::string> overrides;
  ExcitationPlan plan;
  int drive = 1;
  bool json = false;
  RecordOptions records;
};

nlohmann::ordered_json responseJson(const TorqueResponse& r) {
  nlohmann::ordered_json j;
  j["bandwidth_Hz"] = r.bandwidth_Hz();
  j["natural_frequency_Hz"] = r.natural_frequency / kTwoPi;
  j["natural_frequency_sigma_Hz"] = r.natural_frequency_sigma / kTwoPi;
  if (r.order == 2) {
    j["damping_ratio"] = r.damping_ratio;
    j["damping_ratio_sigma"] = r.damping_ratio_sigma;
  }
  j["delay_ms"] = 1e3 * r.delay;
  j["delay_sigma_ms"] = 1e3 * r.delay_sigma;
  j["rms_error"] = r.residual;
  return j;
}

void writeIdentifiedFile(const std::string& path, const std::string& text) {
  writeTextFile(path, text);
  fmt::print(stderr, "identify: wrote {}\n", path);
}

/// The scenario that what is found will change.
struct ScenarioToChange {
  std::string path;
  PlantConfig plant;
  bool mpc = false;
};

ScenarioToChange scenarioToChange(const IdentifyArguments& a, const BenchConfig& config) {
  const bool of_bench = a.scenario.empty();
  ScenarioToChange out;
  out.path = of_bench ? benchScenarioPath(config, a.config) : a.scenario;
  const Scenario scenario =
      loadScenario(out.path, of_bench ? config.overrides : std::vector<std::string>{});
  out.plant = readPlantConfig(scenario.tree);
  const ConfigNode* controller = scenario.tree.find("controller");
  const ConfigNode* kind = controller == nullptr ? nullptr : controller->find("kind");
  out.mpc = kind != nullptr && kind->text() == "mpc";
  if (!out.mpc) {
    fmt::print(stderr,
               "identify: {} has no MPC whose frequency shaping could be matched; --scenario names "
               "another one\n",
               out.path);
  }
  return out;
}

IdentifiedScenario meaningOf(const Identification& found, const IdentifyArguments& a,
                             const ScenarioToChange& scenario) {
  namespace fs = std::filesystem;
  // As seen from the file that is written.
  const fs::path folder = fs::absolute(a.out.empty() ? "." : a.out).parent_path();
  IdentifiedScenario out;
  out.include = fs::absolute(scenario.path).lexically_normal().lexically_relative(folder).string();
  out.group = a.plan.drive < kWheelCount ? "wheel" : "arm";
  out.torque_bandwidth_Hz =
      torqueBandwidthFor(scenario.plant.actuators.of(a.plan.drive),
                         toSeconds(scenario.plant.drive_period), found.second.bandwidth_Hz());
  out.shaping = scenario.mpc && a.plan.drive < kWheelCount;
  return out;
}

/// Identifies, and leaves a record where the bench stopped or one is wanted.
Identification identifyRecorded(BenchRunner& runner, const IdentifyArguments& a,
                                const RunFacts& facts) {
  Identification found;
  RunEnd end;
  std::exception_ptr error;
  try {
    found = identifyDrive(runner, a.plan, interruptFlag());
  } catch (const Error& e) {
    error = std::current_exception();
    end = {e.exitCode(), e.what()};
  }
  runner.release();
  if (auto* realtime = dynamic_cast<RealtimeRunner*>(&runner)) realtime->finish();
  recordRun(runner, facts, end, a.records);
  if (error) std::rethrow_exception(error);
  return found;
}

ExitCode identifyOnBench(IdentifyArguments a) {
  const ConfigNode tree = loadBenchTree(a.config, a.overrides);
  const BenchConfig config = forIdentification(readBenchConfig(tree));
  requireDataSheets(config);
  requireRoom(config);
  a.plan.drive = a.drive - 1;
  const ScenarioToChange scenario = scenarioToChange(a, config);
  std::vector<std::unique_ptr<CanBus>> owned;
  std::vector<CanBus*> ends;
  for (const BusConfig& bus : config.buses) {
    owned.push_back(openCanBus(bus.address, bus.settings));
    ends.push_back(owned.back().get());
  }
  std::unique_ptr<BenchRunner> runner;
  if (config.stepped) {
    runner = std::make_unique<SteppedRunner>(config, ends);
  } else {
    runner = std::make_unique<RealtimeRunner>(config, ends);
  }
  runner->setStopFlag(interruptFlag());
  const std::string& name = config.drives[static_cast<std::size_t>(a.plan.drive)].name;
  fmt::print(stderr, "identify: {} gets up to {} Nm for {:.3g} s. Block its joint.\n", name,
             a.plan.amplitude_Nm + std::abs(a.plan.bias_Nm), a.plan.records * a.plan.record_s);
  const Identification found =
      identifyRecorded(*runner, a, benchFacts(a.config, a.overrides, tree));
  const IdentifiedScenario meaning = meaningOf(found, a, scenario);
  const std::string yaml = identifiedYaml(name, found, meaning);
  if (!a.out.empty()) writeIdentifiedFile(a.out, yaml);
  if (!a.figure.empty()) writeIdentifiedFile(a.figure, bodeSvg(name, found, config.cycleSeconds()));
  if (a.json) {
    nlohmann::ordered_json j;
    j["drive"] = name;
    j["first_order"] = responseJson(found.first);
    j["second_order"] = responseJson(found.second);
    j["torque_bandwidth_Hz"] = meaning.torque_bandwidth_Hz;
    for (const ResponsePoint& p : found.points) {
      j["points"].push_back({{"frequency_Hz", p.frequency_Hz},
                             {"gain", std::abs(p.value)},
                             {"phase_deg", std::arg(p.value) * kDegPerRad}});
    }
    if (auto* realtime = dynamic_cast<RealtimeRunner*>(runner.get())) {
      realtime->finish();
      j["bench"] = benchJson(realtime->bench(), realtime->io());
      j["realtime"] = realtimeJson(*realtime);
    }
    fmt::print("{}\n", jsonText(j));
  } else {
    fmt::print("{}", yaml);
  }
  return ExitCode::kPassed;
}

}  // namespace

void addIdentifyCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command =
      program.add_subcommand("identify", "Excite one drive of a bench and fit its torque response");
  const auto a = std::make_shared<IdentifyArguments>();
  command->add_option("config", a->config, "Bench file, e.g. configs/hil/bench.yaml")->required();
  command->add_option("--drive", a->drive, "1 to 3: wheels, 4 to 6: arm")->check(CLI::Range(1, 6));
  command->add_option("--amplitude-Nm", a->plan.amplitude_Nm, "Peak of the sum of sines")
      ->capture_default_str();
  command->add_option("--bias-Nm", a->plan.bias_Nm, "Constant torque below it")
      ->capture_default_str();
  command->add_option("--low-Hz", a->plan.low_Hz, "Lowest frequency")->capture_default_str();
  command->add_option("--high-Hz", a->plan.high_Hz, "Highest, below half the bus rate")
      ->capture_default_str();
  command->add_option("--record-s", a->plan.record_s, "Length of one period of the signal")
      ->capture_default_str();
  command->add_option("--scenario", a->scenario,
                      "Scenario to change by what is found; default: the bench file's");
  command->add_option(
      "--out", a->out,
      "Write that scenario here, with the actuators and the MPC's frequency shaping\n"
      "of this drive: ballbot run and bode take it");
  command->add_option("--figure", a->figure, "Draw the Bode picture here (SVG)");
  command->add_option("--set", a->overrides, "path=value: change one value of the bench file")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  addRecordOptions(*command, a->records);
  command->add_flag("--json", a->json, "Print fits and points as JSON");
  command->footer(
      "The joint must be blocked, or what is measured is the joint.\n"
      "Example:\n"
      "  ballbot identify configs/hil/bench.yaml --drive 1 --figure wheel.svg \\\n"
      "    --scenario configs/scenarios/balance.yaml --out wheel.yaml\n"
      "  ballbot bode wheel.yaml\n"
      "Exit codes: 0 fitted, 2 bad input or no fit, 3 the bench stopped,\n"
      "5 a drive has not said that its torque is off, 130 interrupted, with the drives off.");
  command->callback([&result, a] { result = identifyOnBench(*a); });
}

}  // namespace ballbot
