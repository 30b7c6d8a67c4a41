#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/angle.hpp"
#include "hil/bus_budget.hpp"
#include "hil/data_sheet_check.hpp"
#include "hil/identify/take_records.hpp"
#include "hil/open_can_bus.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/stepped_runner.hpp"
#include "report/json_text.hpp"
#include "tools/bench_record.hpp"
#include "tools/bench_report.hpp"
#include "tools/bench_scenario.hpp"
#include "tools/commands.hpp"
#include "tools/identify_output.hpp"
#include "tools/identify_report.hpp"
#include "tools/interrupt.hpp"
#include "tools/standing_output.hpp"

namespace ballbot {
namespace {

constexpr std::chrono::milliseconds kSdoPatience{1000};

struct IdentifyArguments {
  std::string config, scenario;
  IdentifyFiles files;
  std::vector<std::string> overrides;
  ExcitationPlan plan;
  IdentifyOptions fit;
  double travel_deg = 57;
  int drive = 1, seeds = 0;
  bool response_only = false, without_back_driven = false, json = false;
  RecordOptions records;
};

std::unique_ptr<BenchRunner> runnerFor(const BenchConfig& config,
                                       const std::vector<CanBus*>& buses) {
  std::unique_ptr<BenchRunner> runner;
  if (config.stepped) {
    runner = std::make_unique<SteppedRunner>(config, buses);
  } else {
    runner = std::make_unique<RealtimeRunner>(config, buses);
  }
  runner->setStopFlag(interruptFlag());
  return runner;
}

/// Records of all postures, one session of the bench each.
struct Taken {
  std::vector<Record> records;
  std::unique_ptr<BenchRunner> runner;  ///< of the last one
};

/// Records of one posture; the bench leaves a record of its own where it stopped or one is wanted.
std::vector<Record> takeRecorded(BenchRunner& runner, Posture posture, const IdentifyArguments& a,
                                 const RunFacts& facts) {
  std::vector<Record> taken;
  RunEnd end;
  std::exception_ptr error;
  try {
    taken = takeRecords(runner, posture, a.plan, interruptFlag());
  } catch (const Error& e) {
    error = std::current_exception();
    end = {e.exitCode(), e.what()};
  }
  runner.release();
  if (auto* realtime = dynamic_cast<RealtimeRunner*>(&runner)) realtime->finish();
  recordRun(runner, facts, end, a.records);
  if (error) std::rethrow_exception(error);
  return taken;
}

Taken takeAll(const IdentifyArguments& a, const BenchConfig& config,
              const std::vector<CanBus*>& buses, const RunFacts& facts) {
  const DriveConfig& drive = config.drives[static_cast<std::size_t>(a.plan.drive)];
  SdoExchange exchange(*buses[static_cast<std::size_t>(drive.bus)], drive.node, kSdoPatience,
                       config.buses[static_cast<std::size_t>(drive.bus)].settings.flexible());
  const bool current = !a.response_only && hasCurrent(exchange);
  const BenchConfig bench = forIdentification(config, current);
  Taken out;
  for (const Posture posture : {Posture::kBlocked, Posture::kFree, Posture::kBackDriven}) {
    if (posture != Posture::kBlocked && !showsCurrent(out.records)) break;
    if (posture == Posture::kBackDriven && a.without_back_driven) break;
    out.runner.reset();
    bringInto(posture, exchange, drive.name);
    fmt::print(stderr, "identify: {}, output {}: up to {} Nm for {:.0f} s\n", drive.name,
               toText(posture), a.plan.amplitude_Nm, secondsOf(posture, a.plan, bench));
    out.runner = runnerFor(bench, buses);
    for (Record& r : takeRecorded(*out.runner, posture, a, facts)) {
      out.records.push_back(std::move(r));
    }
  }
  if (!showsCurrent(out.records) && !a.response_only) {
    fmt::print(stderr,
               "identify: {} shows no motor current (6078), so its response is all that is found\n",
               drive.name);
  }
  return out;
}

/// On the bench file's own emulated stand, in this process: do the sigmas tell the truth?
ExitCode identifyEmulated(const IdentifyArguments& a, const ConfigNode& tree) {
  const IdentifyTrials trials = tryIdentification(readBenchConfig(tree), readEmulatorConfig(tree),
                                                  a.plan, a.fit, a.seeds, interruptFlag());
  if (a.json) {
    fmt::print("{}\n", jsonText(trialsJson(trials)));
  } else {
    fmt::print("{}", trialsTable(trials));
  }
  return trials.honest() ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

/// What is written must not stand where something is read that the result is made of.
void requireOtherFiles(const IdentifyArguments& a, const std::string& scenario) {
  const std::pair<const char*, const std::string&> outputs[] = {
      {"--out", a.files.scenario},
      {"--actuator-out", a.files.actuator},
      {"--bench-out", a.files.bench},
      {"--figure", a.files.figure}};
  for (const auto& [option, path] : outputs) {
    if (path.empty()) continue;
    for (const std::string& input : {a.config, scenario}) {
      std::error_code none;
      if (!std::filesystem::equivalent(path, input, none)) continue;
      throw InputError(fmt::format("{} {}: this file is read, and would be lost; give another name",
                                   option, path));
    }
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!folder.empty() && ::access(folder.c_str(), W_OK) != 0) {
      throw OutputError(
          fmt::format("{} {}: cannot be written: {}", option, path, std::strerror(errno)));
    }
  }
}

ExitCode identifyOnBench(IdentifyArguments a) {
  const ConfigNode tree = loadBenchTree(a.config, a.overrides);
  const BenchConfig config = readBenchConfig(tree);
  requireDataSheets(config);
  requireRoom(config);
  a.plan.drive = a.drive - 1;
  a.plan.travel_rad = a.travel_deg * kRadPerDeg;
  const DriveConfig& drive = config.drives[static_cast<std::size_t>(a.plan.drive)];
  a.fit.assumed_stiffness = drive.scaling.spring_stiffness;
  if (a.seeds > 0) return identifyEmulated(a, tree);
  const ScenarioToChange scenario = scenarioToChange(a.scenario, config, a.config, a.plan.drive);
  requireOtherFiles(a, a.scenario);
  interruptFlag(SecondSignal::kIsAbsorbed);
  std::vector<std::unique_ptr<CanBus>> owned;
  std::vector<CanBus*> buses;
  for (const BusConfig& bus : config.buses) {
    owned.push_back(openCanBus(bus.address, bus.settings));
    buses.push_back(owned.back().get());
  }
  const Taken taken = takeAll(a, config, buses, benchFacts(a.config, a.overrides, tree));
  const Identification found = identify(taken.records, a.fit);
  if (a.json) {
    nlohmann::ordered_json j = identificationJson(found, scenario.configured, drive.name);
    if (auto* realtime = dynamic_cast<RealtimeRunner*>(taken.runner.get())) {
      realtime->finish();
      j["bench"] = benchJson(realtime->bench(), realtime->io());
      j["realtime"] = realtimeJson(*realtime);
    }
    fmt::print("{}\n", jsonText(j));
  } else {
    fmt::print("{}", identificationTable(found, scenario.configured, drive.name));
  }
  if (!found.valid()) {
    fmt::print(stderr,
               "identify: {}. Nothing is written. Is the output as it was asked to be, does the "
               "motor saturate (less --amplitude-Nm), is 6078 the mean of a cycle?\n",
               found.complaint());
    return ExitCode::kRequirementMissed;
  }
  writeIdentified(found, a.files, scenario, config, tree, a.config, a.plan.drive);
  return ExitCode::kPassed;
}

void addExcitationOptions(CLI::App& command, IdentifyArguments& a) {
  command.add_option("--drive", a.drive, "1 to 3: wheels, 4 to 6: arm")->check(CLI::Range(1, 6));
  command.add_option("--amplitude-Nm", a.plan.amplitude_Nm, "The most torque that is asked for")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command.add_option("--low-Hz", a.plan.low_Hz, "Lowest frequency of the torque response")
      ->capture_default_str();
  command.add_option("--high-Hz", a.plan.high_Hz, "Highest, below half the bus rate")
      ->capture_default_str();
  command.add_option("--record-s", a.plan.record_s, "Length of one period of a blocked excitation")
      ->capture_default_str();
  command.add_option("--travel-deg", a.travel_deg, "How far a free output swings")
      ->check(CLI::Range(5.0, 360.0))
      ->capture_default_str();
  command
      .add_option("--least-speed", a.fit.least_speed,
                  "Of the rotor [rad/s]; below it friction is no constant and not looked at")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command.add_flag("--without-back-driven", a.without_back_driven,
                   "Nobody turns the output: load-dependent friction is not identified");
  command.add_flag("--response-only", a.response_only,
                   "Only with the output blocked: bandwidth and delay");
}

void addOutputOptions(CLI::App& command, IdentifyArguments& a) {
  command.add_option("--scenario", a.scenario,
                     "Scenario to change by what is found; default: the bench file's");
  command.add_option(
      "--out", a.files.scenario,
      "Write that scenario here, with the actuators, the plant's delay and the MPC's\n"
      "frequency shaping of this drive: ballbot run and bode take it");
  command.add_option("--actuator-out", a.files.actuator,
                     "Write the actuator here, for robot.actuators: {wheel: {include: FILE}}");
  command.add_option("--bench-out", a.files.bench,
                     "Write the bench file here, with this drive's torque response");
  command.add_option("--figure", a.files.figure, "Draw the Bode picture here (SVG)");
  command
      .add_option("--seeds", a.seeds,
                  "Identify the drive of the bench file's emulated stand in this process, with so\n"
                  "many seeds of its noise, and compare figures and sigmas with what it really is")
      ->check(CLI::Range(1, 10'000));
  command.add_flag("--json", a.json,
                   "Print figures, correlation, held-out records and points as JSON");
}

}  // namespace

void addIdentifyCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "identify",
      "Identify one drive of a bench: spring, rotor, friction, backlash, delay, bandwidth");
  const auto a = std::make_shared<IdentifyArguments>();
  command->add_option("config", a->config, "Bench file, e.g. configs/hil/bench.yaml")->required();
  addExcitationOptions(*command, *a);
  addOutputOptions(*command, *a);
  command->add_option("--set", a->overrides, "path=value: change one value of the bench file")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  addRecordOptions(*command, a->records);
  command->footer(
      "The output is blocked, then free, then turned by hand; you are asked for each, unless the\n"
      "drive stands on a test stand that does it.\n"
      "Example:\n"
      "  ballbot identify configs/hil/stand.yaml --drive 1 --figure wheel.svg \\\n"
      "    --scenario configs/scenarios/balance.yaml --out wheel.yaml\n"
      "  ballbot bode wheel.yaml\n"
      "Exit codes: 0 identified, 1 held-out records do not fit (--seeds: sigmas are not honest), 2 "
      "bad input or no fit, 3 the "
      "bench\n"
      "stopped, 5 a drive has not said that its torque is off, 130 interrupted, with the drives "
      "off.");
  command->callback([&result, a] { result = identifyOnBench(*a); });
}

}  // namespace ballbot
