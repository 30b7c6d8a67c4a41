#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "hil/jitter_histogram.hpp"
#include "hil/realtime_thread.hpp"

namespace ballbot {

/// How the thread that measures the floor is set up.
struct FloorSettings {
  int priority = 80;                   ///< SCHED_FIFO, as the loop's
  std::int64_t period_ns = 1'000'000;  ///< of its wake-ups
  bool realtime = true;                ///< false: an ordinary thread, memory not locked
  int core = -1;                       ///< pinned to it; -1: wherever the kernel puts it
  bool hold_cpu_awake = false;         ///< holds /dev/cpu_dma_latency at 0 meanwhile
};

/// What the kernel alone costs: how late a thread wakes that has nothing to do but sleep until an
/// absolute time, as cyclictest measures it. No loop on this machine, at this load, is better.
class KernelFloor {
 public:
  /// Starts measuring. A thread of the loop's settings, once per period.
  explicit KernelFloor(const FloorSettings& settings);
  /// Ends it.
  ~KernelFloor();
  KernelFloor(const KernelFloor&) = delete;
  KernelFloor& operator=(const KernelFloor&) = delete;

  struct Result {
    JitterHistogram late;
    RealtimeGrant grant;
    bool held_awake = false;  ///< /dev/cpu_dma_latency could be held
    std::int64_t period_ns = 0;
  };
  /// Ends it; afterwards the result stays.
  const Result& finish() noexcept;

 private:
  void run(FloorSettings settings) noexcept;

  Result result_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// The floor over a while, in a thread of its own; ends early once `stop` is set. No memory is
/// locked afterwards.
KernelFloor::Result measureFloor(const FloorSettings& settings, double seconds,
                                 const std::atomic<bool>* stop = nullptr);

}  // namespace ballbot
