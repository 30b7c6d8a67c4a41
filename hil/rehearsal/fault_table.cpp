#include "hil/rehearsal/fault_table.hpp"

#include "hil/rehearsal/fault_trials.hpp"

namespace ballbot {
namespace {

constexpr int kWarmUpCycles = 120;  // ramp over, joints moving
constexpr int kAfterwards = 400;    // watched for torque that comes back: one second
constexpr int kStillOn = -1;

/// The configuration of a trial: the default one, and for the angle limit one that has a limit.
BenchConfig configOf(const Trial& trial) {
  BenchConfig c = Rehearsal::defaultConfig();
  if (trial.reason == BenchFault::kPositionLimit)
    c.drives[3].limits.position_high = kTrialAngleLimit;
  return c;
}

std::string expectedText(Reaction reaction) {
  return reaction == Reaction::kOff ? "torque off" : "damping, then torque off";
}

FaultRow rehearse(const Trial& trial) {
  FaultRow row;
  row.fault = trial.fault;
  row.expected = expectedText(trial.reaction);
  const BenchConfig config = configOf(trial);
  // Off: the decision, and the ramp of the drive's own stop. Damped: its time comes on top.
  row.bound_cycles = trial.detection_cycles + 1 +
                     (trial.reaction == Reaction::kOff ? 1 : config.safety.damping_cycles);
  Rehearsal r(config);
  row.measured_cycles = kStillOn;
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
  row.held = row.measured_cycles >= 0 && row.measured_cycles <= row.bound_cycles &&
             !row.restarted &&
             (safety.fault() == trial.reason || safety.fault() == trial.or_reason) &&
             damped == (trial.reaction == Reaction::kDampThenOff);
  return row;
}

}  // namespace

std::vector<FaultRow> rehearseFaults() {
  std::vector<FaultRow> rows;
  for (const Trial& trial : allTrials()) rows.push_back(rehearse(trial));
  return rows;
}

}  // namespace ballbot
