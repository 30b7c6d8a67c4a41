#pragma once

#include "hil/jitter_histogram.hpp"

namespace ballbot {

/// Where a real-time loop's own time goes: what the kernel takes to wake it, and what it works
/// itself between being awake and having handed its frames over. Waiting for answers is in neither.
struct LoopTimes {
  JitterHistogram act_wake;  ///< from the deadline of the command to the thread running
  JitterHistogram sync_out;  ///< awake to SYNC handed over
  JitterHistogram judge;     ///< answers in to sample passed on
  JitterHistogram act;       ///< awake to command handed over: limits, safety, frames
  JitterHistogram own;       ///< the three together, in one cycle
};

}  // namespace ballbot
