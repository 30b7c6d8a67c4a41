#pragma once

#include <vector>

#include "hil/rehearsal/fault_case.hpp"
#include "hil/rehearsal/fault_table.hpp"

namespace ballbot {

/// Faults that begin at given cycles of a run, and the run through to its last word.
class Trial {
 public:
  struct Timed {
    const FaultCase* fault = nullptr;
    int at_cycle = 0;  ///< from the first one on
  };
  Trial(std::vector<Timed> faults, RunnerKind kind);

  /// Runs it. Fills everything of the row but `fault`, `expected` and `held`.
  FaultRow run();
  /// Damping was seen.
  bool damped() const { return damped_; }
  /// Cycles from a fault's decision until no motor has torque, as its row allows them.
  static int boundOf(const FaultCase& fault);

 private:
  bool begin(FaultRow& row);
  void runWhileReady();
  void runCycles();
  void conclude(FaultRow& row);
  Turn turnOf(int cycle) const;

  std::vector<Timed> faults_;
  Rehearsal rehearsal_;
  int cycles_ = 0;  ///< of the whole run so far: what the commands' phase is counted in
  int longest_ = 0;
  bool damped_ = false;
};

}  // namespace ballbot
