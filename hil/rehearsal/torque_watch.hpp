#pragma once

#include "hil/emulator/emulated_bench.hpp"

namespace ballbot {

/// Looks at the drives themselves, past everything that a bench believes: in which cycle the last
/// motor had torque. Cycles are counted by the SYNCs of bus 0.
class TorqueWatch {
 public:
  explicit TorqueWatch(const EmulatedBench& drives) : drives_(drives) {}

  /// From here on cycles are counted, the next one is 1.
  void begin() {
    counting_ = true;
    cycle_ = last_on_ = 0;
  }
  /// Just before a SYNC, and once at the end: a cycle is over.
  void onCycleEnd() {
    if (!counting_) return;
    if (cycle_ > 0 && torqueOn()) last_on_ = cycle_;
    ++cycle_;
  }
  /// A motor has torque, or is still switched on.
  bool torqueOn() const { return drives_.largestTorque() > 0 || drives_.anyEnergized(); }
  /// The first cycle since begin() from which on there was none.
  int offSince() const { return last_on_ + 1; }
  int cycles() const { return cycle_; }

 private:
  const EmulatedBench& drives_;
  bool counting_ = false;
  int cycle_ = 0, last_on_ = 0;
};

}  // namespace ballbot
