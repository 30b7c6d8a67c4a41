#include "hil/rehearsal/fault_trials.hpp"

#include <limits>

namespace ballbot {
namespace {

using F = EmulatedFault;
using B = BenchFault;
using Once = std::function<void(Rehearsal&)>;
using Each = std::function<void(Rehearsal&, BenchCommand&, int)>;

// Drives that hear nothing any more stop by their own RPDO deadline, 15 ms, and the ramp after it.
constexpr int kDriveDeadline = 8;

Once order(EmulatedFault kind, int drive = 1, double value = 0) {
  return [=](Rehearsal& r) { r.drives().inject({0, kind, drive, value}); };
}

Trial off(const char* fault, int cycles, BenchFault reason, Once once) {
  Trial t{fault, Reaction::kOff, cycles, reason};
  t.once = std::move(once);
  return t;
}
Trial damped(const char* fault, int cycles, BenchFault reason, Once once, Each each = {}) {
  Trial t{fault, Reaction::kDampThenOff, cycles, reason};
  t.once = std::move(once);
  t.each = std::move(each);
  return t;
}
/// A node that leaves "operational": its PDOs end, and its heartbeat says so, whichever is first.
Trial leftOperational(const char* fault, int cycles, EmulatedFault kind) {
  Trial t = off(fault, cycles, B::kDriveStale, order(kind));
  t.or_reason = B::kNodeTrouble;
  return t;
}

/// The rig turns steadily until it stands just behind the limit.
void approachLimit(Rehearsal& r) {
  BenchCommand c;
  c.torque.fill(0.3);
  while (r.bench().master().sample().joint_angle[3] <= kTrialAngleLimit) {
    r.cycle(c);
    if (r.bench().safety().state() == SafetyState::kFault) return;
  }
}

}  // namespace

std::vector<Trial> driveTrials() {
  const SafetyConfig s;
  const int stale = s.stale_cycles, beat = s.heartbeat_cycles + 4;
  return {
      off("drive: over-current, emergency 2310", 1, B::kNodeTrouble,
          order(F::kEmergency, 1, 0x2310)),
      off("drive: supply over-voltage, emergency 3210", 1, B::kNodeTrouble,
          order(F::kEmergency, 4, 0x3210)),
      off("drive: supply under-voltage, emergency 3220", 1, B::kNodeTrouble,
          order(F::kEmergency, 0, 0x3220)),
      off("drive: too hot, emergency 4310", 1, B::kNodeTrouble, order(F::kEmergency, 5, 0x4310)),
      off("drive: fault whose emergency message is lost", 1, B::kDriveFault,
          order(F::kUnannouncedFault, 2, 0x7305)),
      off("drive: heartbeat lost, PDOs go on", beat, B::kNodeTrouble, order(F::kHeartbeatLost)),
      off("drive: PDOs lost, heartbeat goes on", stale, B::kDriveStale, order(F::kPdosLost)),
      off("drive: PDOs a byte short", stale, B::kDriveStale, order(F::kPdosTruncated, 3)),
      off("drive: power loss", stale, B::kDriveStale, order(F::kPowerLoss, 4)),
      off("drive: starts anew by itself", 1, B::kNodeTrouble, order(F::kReboot, 2)),
      leftOperational("drive: stopped by a foreign NMT command", stale, F::kNmtStop),
      leftOperational("drive: set pre-operational by a foreign NMT command", stale,
                      F::kNmtPreOperational),
      off("drive: disabled locally", 1, B::kDriveDroppedOut, order(F::kLocalDisable)),
      off("drive: statusword of no state", 1, B::kDriveDroppedOut,
          order(F::kStatusword, 1, 0x1264)),
      off("drive: position frozen while it turns", 40, B::kEncoderImplausible,
          order(F::kStuckEncoder)),
      off("drive: position jumps by 0.5 rad", 1, B::kEncoderImplausible,
          order(F::kPositionJump, 4, 0.5)),
      damped("drive: velocity beyond its limit", 1, B::kVelocityLimit, order(F::kRunaway, 0, 12.5)),
      damped("drive: angle beyond its limit", 1, B::kPositionLimit, approachLimit),
  };
}

std::vector<Trial> busAndImuTrials() {
  const int stale = SafetyConfig{}.stale_cycles;
  return {
      off("bus: nothing passes any more", kDriveDeadline, B::kDriveStale, order(F::kFrozenBus, 4)),
      off("bus: SYNC held back on its way", stale, B::kDriveStale, order(F::kSyncHeldBack, 4, 20)),
      off("bus: adapter pulled out", kDriveDeadline, B::kBusDown,
          [](Rehearsal& r) { r.pullBus1(); }),
      damped("IMU: lost", stale, B::kImuStale, order(F::kImuLost)),
      damped("IMU: sends one sample for ever", stale, B::kImuStale, order(F::kImuFrozen)),
      damped("robot: leans over", 20, B::kTiltLimit, order(F::kTilt, 0, 0.8)),
  };
}

std::vector<Trial> commandTrials() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Trial hung = off("master: hangs, SYNC goes on", 12, B::kNone, {});
  hung.without_master = true;
  return {
      damped("controller: silent", SafetyConfig{}.watchdog_cycles + 1, B::kCommandTimeout, {},
             [](Rehearsal& r, BenchCommand&, int n) { r.wishes().command_age = n; }),
      damped("controller: command is NaN", 1, B::kCommandNotFinite, {},
             [](Rehearsal&, BenchCommand& c, int) { c.torque[3] = kNan; }),
      damped("controller: command is infinite", 1, B::kCommandNotFinite, {},
             [](Rehearsal&, BenchCommand& c, int) { c.torque[0] = kInfinity; }),
      damped("loop: late by four periods", 1, B::kLateLoop, {},
             [](Rehearsal& r, BenchCommand&, int) { r.wishes().skipped_cycles = 4; }),
      damped("person: Ctrl-C, or the session ends", 1, B::kNone,
             [](Rehearsal& r) { r.wishes().stop = true; }),
      hung,
  };
}

std::vector<Trial> allTrials() {
  std::vector<Trial> all = driveTrials();
  for (auto group : {busAndImuTrials(), commandTrials()}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

}  // namespace ballbot
