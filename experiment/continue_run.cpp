#include "experiment/continue_run.hpp"

#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "cosim/lifecycle.hpp"
#include "experiment/checkpoint_files.hpp"
#include "experiment/plant_factory.hpp"
#include "experiment/recorded_run.hpp"
#include "experiment/robot_controller.hpp"

namespace ballbot {

RunPoint parseRunPoint(const std::string& text) {
  const std::size_t at = text.rfind('@');
  std::optional<double> seconds;
  if (at != std::string::npos && at > 0) {
    std::string moment = text.substr(at + 1);
    if (!moment.empty() && moment.back() == 's') moment.pop_back();
    seconds = parseNumber(moment);
  }
  if (!seconds || !(*seconds >= 0 && *seconds < 1e9)) {
    throw InputError(fmt::format(
        "--from is '{}', must be a run folder and a time, e.g. runs/push-001@4.2s", text));
  }
  return {text.substr(0, at), kSimStart + durationFromSeconds(*seconds)};
}

Checkpoint stateOfRun(const RunFolder& run, SimTime time, const ReplayOptions& options) {
  requireUnedited(run);
  const Scenario scenario = loadScenario(run.scenarioFile());
  const auto summary = readSummary(run);  // an interrupted run has none
  if (summary && toSeconds(time) >= summary->simulated_s) {
    throw InputError(fmt::format("{}: ended at {:.9g} s, so it cannot be continued from {:.9g} s",
                                 run.path(), summary->simulated_s, toSeconds(time)));
  }
  const RunConfig config = readRunConfig(scenario);
  EventCalendar calendar(scenario.rates.base_step);
  RobotController controller(config, calendar);
  Lifecycle plant(makePlant(config.plant));
  MasterOptions master_options;
  master_options.end = kSimStart + scenario.duration;
  master_options.stop = options.stop;
  StepMaster master(plant, controller, calendar, nullptr, master_options);
  if (const auto checkpoint = lastCheckpoint(run, time)) {
    if (checkpoint->time > time) {
      throw InputError(
          fmt::format("{}: begins at {:.9g} s, so it cannot be continued from {:.9g} s", run.path(),
                      toSeconds(checkpoint->time), toSeconds(time)));
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
  const RunConfig config = readRunConfig(changed);
  EventCalendar calendar(changed.rates.base_step);
  RobotController controller(config, calendar);
  Lifecycle plant(makePlant(config.plant));
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
