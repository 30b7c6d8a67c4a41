#pragma once

#include "cosim/recorder.hpp"

namespace ballbot {

/// What of a run is kept, and how often: the `recording:` of a scenario.
struct Recording {
  RecorderOptions log;
  SimDuration checkpoint_period{};  ///< zero: no checkpoints

  void describe(ConfigVisitor& v);
};

}  // namespace ballbot
