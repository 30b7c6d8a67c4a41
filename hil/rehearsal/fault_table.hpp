#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// One line of the fault table: what was done to the bench, what had to come of it, what came.
struct FaultRow {
  std::string fault;
  std::string expected;     ///< "torque off" or "damping, then torque off"
  std::string reason;       ///< what the bench says, or who stopped the drives
  int bound_cycles = 0;     ///< until no motor has torque
  int measured_cycles = 0;  ///< -1: it still had when the time was over
  bool restarted = false;   ///< torque came back without anybody asking
  bool held = false;
};

/// Tries every fault on a fresh rehearsal with torque on and joints in motion.
std::vector<FaultRow> rehearseFaults();

}  // namespace ballbot
