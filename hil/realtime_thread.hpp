#pragma once

#include <cstdint>
#include <string>

namespace ballbot {

/// What the system has granted the calling thread.
struct RealtimeGrant {
  bool fifo = false;           ///< SCHED_FIFO at the priority asked for
  bool locked_memory = false;  ///< mlockall
  /// "SCHED_FIFO 80, memory locked", or what was refused and how to get it.
  std::string text;
};

/// Asks for SCHED_FIFO and locked memory, for the calling thread. Never fails: the loop runs
/// without them too, only later.
RealtimeGrant becomeRealtime(int priority);

/// CLOCK_MONOTONIC [ns].
std::int64_t monotonicNs() noexcept;
/// Sleeps until this time of the same clock.
void sleepUntilNs(std::int64_t time_ns) noexcept;

}  // namespace ballbot
