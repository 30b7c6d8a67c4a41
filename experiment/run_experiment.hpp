#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/time.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/serve.hpp"
#include "cosim/step_master.hpp"
#include "cosim/stepped_controller.hpp"
#include "experiment/run_config.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/scenario.hpp"
#include "experiment/verdict.hpp"

namespace ballbot {

/// Makes what balances the robot of a run, and its tasks into the calendar.
using ControllerMaker =
    std::function<std::unique_ptr<SteppedController>(const RunConfig&, EventCalendar&)>;

struct RunOptions {
  /// Instead of the scenario's own controller, whose settings still say what is asked of the run.
  ControllerMaker make_controller;
  /// Controller and plant in one process, joined by a function call; same bits, no LCM.
  bool in_process = false;
  /// The plant's process is met on the shared LCM address, where others can listen.
  bool live = false;
  /// Empty: a plant process is started and met on an address of its own. Otherwise whoever serves
  /// at this LCM URL and channel stands in the plant's place.
  std::string lcm_url, channel;
  /// Controller and plant on one processor: in a lockstep they never work at once, and a switch
  /// within a core is quicker than a wake-up of another.
  bool pin = true;
  /// At this time the plant is saved, its process killed, and a new one continues (a proof that
  /// the saved state is complete). Negative: never.
  SimTime replace_plant_at = simTimeFromNs(-1);
  /// Silence after which the plant counts as lost.
  std::chrono::milliseconds patience{10'000};
  /// What to begin with instead of the beginning: see adaptState().
  std::optional<Checkpoint> start;
  bool write_report = true;
  const std::atomic<bool>* stop = nullptr;
  /// Called once the folder is there and before anything is simulated.
  std::function<void(const RunFolder&)> started;
  std::function<void(SimTime now)> progress;
  /// Words of a plant that is long at work, e.g. drives that are being set up.
  std::function<void(const std::string&)> say;
};

struct RunResult {
  explicit RunResult(RunFolder where) : folder(std::move(where)) {}

  RunFolder folder;
  bool passed = false;
  bool fell = false;
  bool completed = false;  ///< false: it ended early, because the robot fell
  /// An LQR stood in all the time for an MPC that never had a plan: such a run does not pass, for
  /// it says nothing of the controller it is about.
  bool no_plan_acted = false;
  /// What was not finite of a plan, if it is known: "cost of the task 'lean' is not finite".
  std::string plan_trouble;
  SimTime end{};
  std::string trajectory_digest, log_digest;
  std::map<std::string, double> metrics;
  std::vector<VerdictRow> verdicts;
  double wall_seconds = 0;

  ExitCode exitCode() const { return passed ? ExitCode::kPassed : ExitCode::kRequirementMissed; }
};

/// Runs a scenario and leaves everything about it in a run folder, which is made at `out` (see
/// RunFolder::create) once the whole scenario has been found good.
/// @throw Error of the kind that tells the caller's exit code; what was logged stays readable.
RunResult runExperiment(const Scenario& scenario, const std::string& out,
                        const RunOptions& options);

/// The plant of a scenario at the far end of the step protocol, until the master says bye.
/// @throw InputError, LostParticipantError
/// @param options  its config_digest is set here, from the scenario
void servePlant(const Scenario& scenario, const LcmAddress& address, ServeOptions options);

}  // namespace ballbot
