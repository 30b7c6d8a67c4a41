#pragma once

#include <functional>
#include <vector>

#include "hil/rehearsal/rehearsal.hpp"
#include "hil/safety.hpp"

namespace ballbot {

/// Limit of joint 4 in the trial of the angle limit [rad].
constexpr double kTrialAngleLimit = 0.6;

/// What has to come of a fault.
enum class Reaction {
  kOff,          ///< torque off at once
  kDampThenOff,  ///< bounded damping, then torque off
};

/// One fault of the table: how it is done to the bench, and what the bench must make of it.
struct Trial {
  const char* fault = "";
  Reaction reaction = Reaction::kOff;
  int detection_cycles = 1;  ///< from the fault to the decision, at most
  /// What the bench must say; kNone: it did not decide itself.
  BenchFault reason = BenchFault::kNone;
  std::function<void(Rehearsal&)> once = {};  ///< before the first cycle
  /// In every cycle from then on; the last argument counts from 1.
  std::function<void(Rehearsal&, BenchCommand&, int)> each = {};
  bool without_master = false;  ///< the master says nothing any more but SYNC
  /// Where what comes first depends on the phase of the heartbeat: the other reason.
  BenchFault or_reason = reason;
};

/// Faults inside a drive, of its network and of its encoder.
std::vector<Trial> driveTrials();
/// Faults of the buses, the IMU and the robot's attitude.
std::vector<Trial> busAndImuTrials();
/// Faults of whoever commands: controller, loop, person, master.
std::vector<Trial> commandTrials();

/// All of them, in the order of the table.
std::vector<Trial> allTrials();

}  // namespace ballbot
