#pragma once

#include <cstdint>

#include "hil/realtime_thread.hpp"

namespace ballbot {

/// The clock of a real-time loop: the machine's, or, where the loop itself is tried out, one that
/// moves when its owner says so.
class LoopClock {
 public:
  virtual ~LoopClock() = default;
  /// CLOCK_MONOTONIC, or what stands for it [ns].
  virtual std::int64_t now() noexcept { return monotonicNs(); }
  virtual void sleepUntil(std::int64_t time_ns) noexcept { sleepUntilNs(time_ns); }
  /// Called by the loop's thread before its first cycle.
  virtual RealtimeGrant prepareThread(int priority) { return becomeRealtime(priority); }
  /// Called by it after its last one.
  virtual void leaveThread() noexcept {}
};

}  // namespace ballbot
