#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "cosim/step_master.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/scenario.hpp"

namespace ballbot {

/// A moment of a recorded run, as people write it: "runs/push-001@4.2s".
struct RunPoint {
  std::string run;
  SimTime time{};
};
/// @throw InputError saying how it is written.
RunPoint parseRunPoint(const std::string& text);

/// How far the way to a moment of a run is to be simulated again.
struct ReplayOptions {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(SimTime now)> progress;
};

/// State of a recorded run at its first event at or after a moment: its last checkpoint before, or
/// its beginning, simulated again from there on, which gives the bits of the run.
/// @throw InputError if the run did not reach that moment, or its folder is not as it left it.
Checkpoint stateOfRun(const RunFolder& run, SimTime time, const ReplayOptions& options);

/// What a run of `changed` begins with that goes on from a state of a run of `original`. Plant,
/// estimator and, where the section `controller` is the same, the balancing law go on as they
/// were; another law plans anew, at once.
/// @throw InputError if the state is none of the changed scenario's plant or estimator.
Checkpoint adaptState(const Checkpoint& state, const Scenario& original, const Scenario& changed);

}  // namespace ballbot
