#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/jitter_histogram.hpp"
#include "hil/machine/proc_text.hpp"
#include "hil/machine/realtime_rows.hpp"
#include "hil/realtime_thread.hpp"

namespace ballbot {

/// What was measured of the kernel's floor, each in turn and round after round, so that what else
/// the machine does meets all of them alike. All but one pinned to the loop's core.
struct FloorMeasurements {
  JitterHistogram fifo;      ///< as the loop is: SCHED_FIFO
  JitterHistogram ordinary;  ///< an ordinary thread
  JitterHistogram awake;     ///< SCHED_FIFO with /dev/cpu_dma_latency held at 0
  JitterHistogram unpinned;  ///< SCHED_FIFO, wherever the kernel puts it
  RealtimeGrant grant;
  bool held_awake = false;  ///< /dev/cpu_dma_latency could be held
  InterruptTable interrupts_before, interrupts_after;
  std::int64_t stolen_ms = 0;  ///< that the host of a virtual machine took from the core
  double seconds = 0;          ///< from before to after
};

/// Measures for about four times `seconds`. Changes nothing that outlasts it.
FloorMeasurements measureFloors(int core, double seconds, const std::atomic<bool>* stop);

/// Fills in what each row is worth here: from the measurements, or why it cannot be measured. Pure.
void addWorth(std::vector<RealtimeRow>& rows, const FloorMeasurements& measured, int core);

}  // namespace ballbot
