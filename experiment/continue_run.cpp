#include "experiment/continue_run.hpp"

#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "cosim/lifecycle.hpp"
#include "experiment/checkpoint_files.hpp"
#include "experiment/plant_link.hpp"
#include "experiment/robot_controller.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

/// Where a run ended, if its summary says so: an interrupted run has none.
std::optional<double> endOf(const RunFolder& run) {
  try {
    return nlohmann::json::parse(readTextFile(run.summaryFile())).at("simulated_s").get<double>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

RunPoint parseRunPoint(const std::string& text) {
  const std::size_t at = text.rfind('@');
  double seconds = -1;
  bool good = at != std::string::npos && at > 0;
  if (good) {
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data() + at + 1, end, seconds);
    const std::string unit(stopped, end);
    good = error == std::errc() && (unit.empty() || unit == "s") && seconds >= 0 && seconds < 1e9;
  }
  if (!good) {
    throw InputError(fmt::format(
        "--from is '{}', must be a run folder and a time, e.g. runs/push-001@4.2s", text));
  }
  return {text.substr(0, at), kSimStart + durationFromSeconds(seconds)};
}

Checkpoint stateOfRun(const RunFolder& run, SimTime time, const ReplayOptions& options) {
  const Scenario scenario = loadScenario(run.scenarioFile());
  const std::optional<double> end = endOf(run);
  if (end && toSeconds(time) >= *end) {
    throw InputError(fmt::format("{}: ended at {:.9g} s, so it cannot be continued from {:.9g} s",
                                 run.path(), *end, toSeconds(time)));
  }
  EventCalendar calendar(scenario.rates.base_step);
  RobotController controller(scenario, calendar);
  Lifecycle plant(makePlant(scenario));
  MasterOptions master_options;
  master_options.end = kSimStart + scenario.duration;
  master_options.stop = options.stop;
  StepMaster master(plant, controller, calendar, nullptr, master_options);
  if (const auto checkpoint = lastCheckpoint(run, time)) {
    if (checkpoint->time > time) {
      throw InputError(fmt::format("{}: begins at {:.9g} s, so it cannot be continued from {:.9g} s",
                                   run.path(), toSeconds(checkpoint->time), toSeconds(time)));
    }
    master.restore(*checkpoint);
  } else {
    master.initialize();
  }
  while (master.time() < time && master.step()) {
    if (options.progress) options.progress(master.time());
  }
  return master.save();
}

Checkpoint adaptState(const Checkpoint& state, const Scenario& original, const Scenario& changed) {
  const bool same_law =
      toYaml(original.section("controller")) == toYaml(changed.section("controller"));
  EventCalendar calendar(changed.rates.base_step);
  RobotController controller(changed, calendar);
  Lifecycle plant(makePlant(changed));
  Checkpoint out = state;
  try {
    plant.enterInitializationMode(kSimStart);
    plant.exitInitializationMode();
    plant.restoreState(state.participant);
    if (same_law) {
      controller.restoreState(state.controller);
    } else {
      controller.takeOver(state.controller);
    }
  } catch (const InputError& e) {
    throw InputError(fmt::format("the run cannot be continued with these settings: {}", e.what()));
  }
  out.controller = controller.saveState();
  return out;
}

}  // namespace ballbot
