#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/rehearsal/fault_case.hpp"

namespace ballbot {

/// One line of the fault table: what was done to the bench, what had to come of it, what came.
struct FaultRow {
  std::string fault;
  RunnerKind runner = RunnerKind::kStepped;
  std::string expected;     ///< "torque off", "damping, then torque off", "says that torque is on"
  std::string reason;       ///< what the bench says, or who stopped the drives
  std::string check;        ///< name of the check that fired first, "none"
  int bound_cycles = 0;     ///< until no motor has torque
  int measured_cycles = 0;  ///< -1: it still had when the time was over
  int exit_code = 0;        ///< of `ballbot hil` after it
  bool says_off = false;    ///< the bench says that the torque is off
  bool torque_on = false;   ///< a motor has torque at the end
  bool held = false;
};

/// Tries every fault on a fresh rehearsal with torque on and joints in motion, in both runners
/// where both can have it.
std::vector<FaultRow> rehearseFaults();

/// One fault in one runner.
FaultRow rehearse(const FaultCase& fault, RunnerKind kind);

/// Random combinations of two or three faults of the table, each beginning up to 20 cycles after
/// the other, in either runner. A row holds if the torque is off by the latest bound of its faults,
/// or is said to be on, and the run neither passes nor says "off" wrongly.
std::vector<FaultRow> rehearseRandomFaults(int count, std::uint64_t seed);

}  // namespace ballbot
