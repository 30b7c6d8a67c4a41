#pragma once

#include "cosim/recorder.hpp"
#include "experiment/scenario.hpp"

namespace ballbot {

/// What of a run is kept, and how often: the `recording:` of a scenario.
struct Recording {
  RecorderOptions log;
  SimDuration checkpoint_period{};  ///< zero: no checkpoints

  void describe(ConfigVisitor& v);
};

/// Sensors and estimates are kept as often as the estimator runs, if nothing else is said.
/// @throw InputError with file, line and column.
Recording readRecording(const Scenario& scenario);

}  // namespace ballbot
