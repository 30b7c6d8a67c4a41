#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cosim/lcm_transport.hpp"
#include "experiment/continue_run.hpp"
#include "experiment/run_experiment.hpp"
#include "experiment/run_record.hpp"
#include "model/robot_urdf.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"
#include "tools/result_table.hpp"

namespace ballbot {
namespace {

struct RunArguments {
  std::string scenario, from, out;
  std::string lcm_url, channel = "BALLBOT";
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  bool live = false, in_process = false, no_pin = false, no_report = false, json = false,
       quiet = false;
  double replace_plant_at_s = -1;
  double patience_s = 10;
};

/// What a run begins with that goes on from a moment of another.
Checkpoint startFrom(const RunPoint& from, const Scenario& changed, bool quiet) {
  const RunFolder run = RunFolder::open(from.run);
  const Scenario original = loadScenario(run.scenarioFile());
  if (from.time >= kSimStart + changed.duration) {
    throw InputError(
        fmt::format("--from is at {:.9g} s, but the run ends at {:.9g} s; try --set duration_s=...",
                    toSeconds(from.time), toSeconds(changed.duration)));
  }
  Progress progress("to " + toText(from.time), quiet);
  ReplayOptions replay;
  replay.stop = interruptFlag();
  replay.progress = [&](SimTime now) {
    if (toNs(now) % 10'000'000 == 0) progress.update(toSeconds(now) / toSeconds(from.time), "");
  };
  const Checkpoint start = adaptState(stateOfRun(run, from.time, replay), original, changed);
  progress.finish();
  return start;
}

ExitCode runScenario(const RunArguments& arguments) {
  std::optional<RunPoint> from;
  if (!arguments.from.empty()) from = parseRunPoint(arguments.from);
  if (!from && arguments.scenario.empty()) {
    throw InputError("run: give a scenario, or --from and a moment of a run");
  }
  const std::string file = from ? RunFolder::open(from->run).scenarioFile() : arguments.scenario;
  const Scenario scenario = loadScenario(file, arguments.overrides, arguments.seed);

  for (const std::string& note : readRobotUrdf(scenario.section("robot")).read.notes) {
    fmt::print(stderr, "note: {}\n", note);
  }

  RunOptions options;
  if (from) options.start = startFrom(*from, scenario, arguments.quiet);
  Progress progress(scenario.name, arguments.quiet);
  options.in_process = arguments.in_process;
  options.lcm_url = arguments.lcm_url;
  options.channel = arguments.channel;
  options.pin = !arguments.no_pin;
  options.live = arguments.live;
  options.write_report = !arguments.no_report;
  if (arguments.replace_plant_at_s >= 0) {
    options.replace_plant_at = kSimStart + durationFromSeconds(arguments.replace_plant_at_s);
  }
  options.patience = std::chrono::milliseconds(static_cast<int>(1000 * arguments.patience_s));
  options.stop = interruptFlag();
  const double duration_s = toSeconds(scenario.duration);
  options.progress = [&](SimTime now) {
    // Every tick asks; a redraw is cheap only if the text is made for those that draw.
    if (toNs(now) % 10'000'000 == 0) {
      progress.update(toSeconds(now) / duration_s,
                      fmt::format("{:5.2f} of {:g} s", toSeconds(now), duration_s));
    }
  };
  if (!arguments.quiet) {
    options.say = [last =
                       std::chrono::steady_clock::time_point{}](const std::string& text) mutable {
      const auto now = std::chrono::steady_clock::now();
      if (now - last < std::chrono::seconds(3)) return;
      last = now;
      fmt::print(stderr, "{}\n", text);
    };
  }
  std::string folder;
  options.started = [&](const RunFolder& made) { folder = made.path(); };
  const RunResult result = [&] {
    try {
      return runExperiment(scenario, arguments.out, options);
    } catch (const Error&) {
      progress.finish();
      if (!folder.empty()) fmt::print(stderr, "What was recorded until then is in {}\n", folder);
      throw;
    }
  }();
  progress.finish();

  if (arguments.json) {
    nlohmann::ordered_json json = summaryJson(scenario, result);
    json["run_folder"] = result.folder.path();
    fmt::print("{}\n", jsonText(json));
  } else {
    fmt::print("{}", resultTable(scenario, result));
  }
  return result.exitCode();
}

/// What `run` and `controller` have in common.
void addSharedOptions(CLI::App* command, const std::shared_ptr<RunArguments>& a) {
  command->add_option("scenario", a->scenario, "Scenario file")->required();
  command->add_option("--out", a->out,
                      "Run folder to create (default: the next free runs/NAME-NNN)");
  command
      ->add_option("--set", a->overrides,
                   "path=value: change one value of the scenario; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--seed", a->seed, "Seed of every noise source, instead of the scenario's");
  command->add_option("--channel", a->channel, "LCM channel to meet at")->capture_default_str();
  command
      ->add_option("--patience-s", a->patience_s,
                   "Silence after which the plant counts as lost [s]")
      ->check(CLI::Range(0.1, 1e5))
      ->capture_default_str();
  command->add_flag("--no-pin", a->no_pin, "Do not keep this process on one processor");
  command->add_flag("--no-report", a->no_report, "Do not write report.html");
  command->add_flag("--json", a->json, "Print the summary as JSON");
  command->add_flag("--quiet", a->quiet, "No progress on stderr");
}

}  // namespace

void addRunCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand("run", "Run one scenario and leave a run folder");
  const auto a = std::make_shared<RunArguments>();
  addSharedOptions(command, a);
  CLI::Option* scenario = command->get_option("scenario")->required(false);
  command
      ->add_option("--from", a->from,
                   "RUN@TIME: go on from a moment of a recorded run, with its scenario and --set")
      ->excludes(scenario);
  CLI::Option* in_process = command->add_flag(
      "--in-process", a->in_process, "Controller and plant in one process; same bits, no LCM");
  command->add_option(
      "--lcm-url", a->lcm_url,
      "Do not start a plant: meet whoever serves at this LCM URL, e.g. ballbot plant");
  command->add_flag("--live", a->live, "Meet the plant where ballbot view --live listens")
      ->excludes(in_process);
  command->add_option("--replace-plant-at", a->replace_plant_at_s,
                      "At this time [s] save the plant, kill its process, continue in a new one");
  command->footer(
      "Examples:\n"
      "  ballbot run configs/scenarios/balance.yaml\n"
      "  ballbot run configs/scenarios/push.yaml --seed 7 --set plant.fidelity.actuators=ideal "
      "--json\n"
      "  ballbot run --from runs/push-001@4.2s --set controller.kind=lqr\n"
      "  ballbot run configs/scenarios/push.yaml --lcm-url 'udpm://239.255.76.67:7667?ttl=0'\n"
      "Exit codes: 0 passed, 1 a requirement was missed, 2 bad input, 3 a participant was lost,\n"
      "4 output could not be written, 130 interrupted.");
  command->callback([&result, a] { result = runScenario(*a); });
}

void addControllerCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "controller", "Run a scenario's controller against a plant that is served over LCM");
  const auto a = std::make_shared<RunArguments>();
  a->lcm_url = sharedLcmAddress().url;
  a->channel = sharedLcmAddress().channel;
  addSharedOptions(command, a);
  command->add_option("--lcm-url", a->lcm_url, "LCM URL at which the plant is served")
      ->capture_default_str();
  command->footer(
      "Example, two terminals:\n"
      "  ballbot plant configs/scenarios/balance.yaml\n"
      "  ballbot controller configs/scenarios/balance.yaml\n"
      "Exit codes as for run; and 5: a drive of the bench has not said that its torque is off.");
  command->callback([&result, a] { result = runScenario(*a); });
}

}  // namespace ballbot
