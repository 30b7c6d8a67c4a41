#include "hil/rehearsal/fault_table.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {
namespace {

constexpr int kWarmUpCycles = 120;  // ramp over, joints moving
constexpr int kAfterwards = 400;    // watched for torque that comes back: one second
constexpr int kNoReaction = -1;

enum class Reaction { kOff, kDampThenOff, kNone };

/// How a fault is done to the bench: once, and in every cycle from then on.
struct Trial {
  const char* fault;
  Reaction reaction;
  int detection_cycles;  ///< from the fault to the decision, at most
  BenchFault reason;     ///< kNone: the bench itself did not decide
  std::function<void(Rehearsal&)> once;
  std::function<void(Rehearsal&, BenchCommand&, int)> each;
  bool without_master = false;
  /// What comes first may depend on the phase of the heartbeat.
  BenchFault or_reason = reason;
};

std::function<void(Rehearsal&)> order(EmulatedFault kind, int drive = 1, double value = 0) {
  return [=](Rehearsal& r) { r.drives().inject({0, kind, drive, value}); };
}

std::vector<Trial> trials() {
  using F = EmulatedFault;
  using B = BenchFault;
  using R = Reaction;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const SafetyConfig s;
  const int stale = s.stale_cycles, beat = s.heartbeat_cycles + 4;
  // Drives that hear nothing any more stop by their own RPDO deadline, 15 ms.
  const int deadline = 8;
  return {
      {"drive: over-current, emergency 2310",
       R::kOff,
       1,
       B::kNodeTrouble,
       order(F::kEmergency, 1, 0x2310),
       {}},
      {"drive: supply over-voltage, emergency 3210",
       R::kOff,
       1,
       B::kNodeTrouble,
       order(F::kEmergency, 4, 0x3210),
       {}},
      {"drive: supply under-voltage, emergency 3220",
       R::kOff,
       1,
       B::kNodeTrouble,
       order(F::kEmergency, 0, 0x3220),
       {}},
      {"drive: too hot, emergency 4310",
       R::kOff,
       1,
       B::kNodeTrouble,
       order(F::kEmergency, 5, 0x4310),
       {}},
      {"drive: fault whose emergency message is lost",
       R::kOff,
       1,
       B::kDriveFault,
       order(F::kUnannouncedFault, 2, 0x7305),
       {}},
      {"drive: heartbeat lost, PDOs go on",
       R::kOff,
       beat,
       B::kNodeTrouble,
       order(F::kHeartbeatLost),
       {}},
      {"drive: PDOs lost, heartbeat goes on",
       R::kOff,
       stale,
       B::kDriveStale,
       order(F::kPdosLost),
       {}},
      {"drive: PDOs a byte short", R::kOff, stale, B::kDriveStale, order(F::kPdosTruncated, 3), {}},
      {"drive: power loss", R::kOff, stale, B::kDriveStale, order(F::kPowerLoss, 4), {}},
      {"drive: starts anew by itself", R::kOff, 1, B::kNodeTrouble, order(F::kReboot, 2), {}},
      {"drive: stopped by a foreign NMT command",
       R::kOff,
       stale,
       B::kDriveStale,
       order(F::kNmtStop),
       {},
       false,
       B::kNodeTrouble},
      {"drive: set pre-operational by a foreign NMT command",
       R::kOff,
       stale,
       B::kDriveStale,
       order(F::kNmtPreOperational),
       {},
       false,
       B::kNodeTrouble},
      {"drive: disabled locally", R::kOff, 1, B::kDriveDroppedOut, order(F::kLocalDisable), {}},
      {"drive: statusword of no state",
       R::kOff,
       1,
       B::kDriveDroppedOut,
       order(F::kStatusword, 1, 0x1264),
       {}},
      {"drive: position frozen while it turns",
       R::kOff,
       40,
       B::kEncoderImplausible,
       order(F::kStuckEncoder),
       {}},
      {"drive: position jumps by 0.5 rad",
       R::kOff,
       1,
       B::kEncoderImplausible,
       order(F::kPositionJump, 4, 0.5),
       {}},
      {"drive: velocity beyond its limit",
       R::kDampThenOff,
       1,
       B::kVelocityLimit,
       order(F::kRunaway, 0, 12.5),
       {}},
      {"drive: angle beyond its limit",
       R::kDampThenOff,
       1,
       B::kPositionLimit,
       [](Rehearsal& r) {
         // The rig turns steadily; the limit stands just ahead of it.
         while (r.bench().master().sample().joint_angle[3] <= 0.6) {
           BenchCommand c;
           c.torque.fill(0.3);
           r.cycle(c);
           if (r.bench().safety().state() == SafetyState::kFault) return;
         }
       },
       {}},
      {"bus: nothing passes any more",
       R::kOff,
       deadline,
       B::kDriveStale,
       order(F::kFrozenBus, 4),
       {}},
      {"bus: adapter pulled out",
       R::kOff,
       deadline,
       B::kBusDown,
       [](Rehearsal& r) { r.pullBus1(); },
       {}},
      {"IMU: lost", R::kDampThenOff, stale, B::kImuStale, order(F::kImuLost), {}},
      {"IMU: sends one sample for ever",
       R::kDampThenOff,
       stale,
       B::kImuStale,
       order(F::kImuFrozen),
       {}},
      {"robot: leans over", R::kDampThenOff, 20, B::kTiltLimit, order(F::kTilt, 0, 0.8), {}},
      {"controller: silent",
       R::kDampThenOff,
       s.watchdog_cycles + 1,
       B::kCommandTimeout,
       {},
       [](Rehearsal& r, BenchCommand&, int n) { r.wishes().command_age = n; }},
      {"controller: command is NaN",
       R::kDampThenOff,
       1,
       B::kCommandNotFinite,
       {},
       [=](Rehearsal&, BenchCommand& c, int) { c.torque[3] = kNan; }},
      {"controller: command is infinite",
       R::kDampThenOff,
       1,
       B::kCommandNotFinite,
       {},
       [](Rehearsal&, BenchCommand& c, int) { c.torque[0] = INFINITY; }},
      {"loop: late by four periods",
       R::kDampThenOff,
       1,
       B::kLateLoop,
       {},
       [](Rehearsal& r, BenchCommand&, int) { r.wishes().skipped_cycles = 4; }},
      {"person: Ctrl-C, or the session ends",
       R::kDampThenOff,
       1,
       B::kNone,
       [](Rehearsal& r) { r.wishes().stop = true; },
       {}},
      {"master: hangs, SYNC goes on", R::kOff, 12, B::kNone, {}, {}, true},
      {"drive: warning bit", R::kNone, 0, B::kNone, order(F::kWarning), {}},
  };
}

/// The configuration of a trial: the default one, and for the angle limit one that has a limit.
BenchConfig configOf(const Trial& trial) {
  BenchConfig c = Rehearsal::defaultConfig();
  if (trial.reason == BenchFault::kPositionLimit) c.drives[3].limits.position_high = 0.6;
  return c;
}

std::string expectedText(Reaction reaction) {
  switch (reaction) {
    case Reaction::kOff:
      return "torque off";
    case Reaction::kDampThenOff:
      return "damping, then torque off";
    case Reaction::kNone:
      break;
  }
  return "no reaction";
}

FaultRow rehearse(const Trial& trial) {
  FaultRow row;
  row.fault = trial.fault;
  row.expected = expectedText(trial.reaction);
  const BenchConfig config = configOf(trial);
  // Off: the decision, and the ramp of the drive's own stop. Damped: its time comes on top.
  row.bound_cycles =
      trial.reaction == Reaction::kNone
          ? 0
          : trial.detection_cycles + 1 +
                (trial.reaction == Reaction::kOff ? 1 : config.safety.damping_cycles);
  Rehearsal r(config);
  row.measured_cycles = kNoReaction;
  if (!r.engage()) {
    row.reason = "could not be engaged: " + r.bench().faultText();
    return row;
  }
  BenchCommand command;
  command.torque.fill(0.3);
  for (int i = 0; i < kWarmUpCycles; ++i) r.cycle(command);
  if (!r.torqueOn()) {
    row.reason = "lost its torque before the fault: " + r.bench().faultText();
    return row;
  }
  if (trial.once) trial.once(r);
  bool damped = r.bench().safety().action() == SafetyAction::kDamp;
  for (int n = 1; n <= row.bound_cycles + kAfterwards; ++n) {
    if (trial.each) trial.each(r, command, n);
    trial.without_master ? r.cycleWithoutMaster() : r.cycle(command);
    damped = damped || r.bench().safety().action() == SafetyAction::kDamp;
    if (!r.torqueOn() && row.measured_cycles < 0) row.measured_cycles = n;
    if (r.torqueOn() && row.measured_cycles >= 0) row.restarted = true;
  }
  const Safety& safety = r.bench().safety();
  row.reason = trial.without_master                    ? "the drives' own watch over the master"
               : safety.state() == SafetyState::kFault ? r.bench().faultText()
                                                       : toText(safety.state());
  if (trial.reaction == Reaction::kNone) {
    row.held = row.measured_cycles < 0 && safety.state() == SafetyState::kEnabled;
    return row;
  }
  row.held = row.measured_cycles >= 0 && row.measured_cycles <= row.bound_cycles &&
             !row.restarted &&
             (safety.fault() == trial.reason || safety.fault() == trial.or_reason) &&
             damped == (trial.reaction == Reaction::kDampThenOff);
  return row;
}

}  // namespace

std::vector<FaultRow> rehearseFaults() {
  std::vector<FaultRow> rows;
  for (const Trial& trial : trials()) rows.push_back(rehearse(trial));
  return rows;
}

}  // namespace ballbot
