#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hil/bench_fault.hpp"
#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {

/// What has to come of a fault.
enum class Reaction {
  kOff,          ///< torque off at once
  kDampThenOff,  ///< bounded damping, then torque off
  kSaid,         ///< torque cannot be taken away: that is said, loudly, with the node's name
};

/// What the controller does in a cycle of a trial.
struct Turn {
  BenchCommand command;
  bool silent = false;
};

/// One row of the fault table: how it is done to the bench, from outside, and what the bench must
/// make of it.
struct FaultCase {
  std::string name;
  Reaction reaction = Reaction::kOff;
  /// From the fault to the decision, at most.
  int detection_cycles = 1;
  /// What the bench may say; empty: it need not decide itself.
  std::vector<BenchFault> reasons;
  /// Before the first cycle: on the wire, in a drive, at the keyboard.
  std::function<void(Rehearsal&)> start = {};
  /// In every cycle from then on; the last argument counts from 1.
  std::function<void(Rehearsal&, Turn&, int)> each = {};
  /// Begins while the drives are ready and nobody has engaged them.
  bool while_ready = false;
  bool without_master = false;  ///< the master says nothing any more but SYNC
  bool stepped = true, real_time = true;
  int way_down_cycles = 0;  ///< that a drive may take longer because it disobeys at first
};

/// Limit of joint 4 in the trial of the angle limit [rad].
constexpr double kTrialAngleLimit = 0.6;

// The rows, by where the fault is.
std::vector<FaultCase> driveCases();     ///< inside a drive
std::vector<FaultCase> statusCases();    ///< what a drive says of its state
std::vector<FaultCase> encoderCases();   ///< measurements of a drive
std::vector<FaultCase> pdoCases();       ///< the timing and wholeness of its data
std::vector<FaultCase> imuCases();       ///< the IMU and the robot's attitude
std::vector<FaultCase> busCases();       ///< buses and adapters
std::vector<FaultCase> intruderCases();  ///< somebody else on the bus
std::vector<FaultCase> commandCases();   ///< controller, loop, person, master
std::vector<FaultCase> wayDownCases();   ///< drives that do not obey

/// All of them, in the order of the table.
std::vector<FaultCase> allCases();

}  // namespace ballbot
