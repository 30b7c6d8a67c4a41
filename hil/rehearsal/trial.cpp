#include "hil/rehearsal/trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr int kWarmUpCycles = 120;  // ramp over, joints moving
// Watched for torque that comes back: a second of SYNCs; a quarter where the loop is tried.
constexpr int kAfterwards = 400, kAfterwardsInLockstep = 100;
constexpr int kReadySyncs = 40;  // after set-up the drives are ready well before
constexpr double kCommandFrequency = 8, kCommandTorque = 0.5;  // [Hz], [N m]

/// The configuration of a trial: the default one, and for the angle limit one that has a limit.
BenchConfig configOf(const std::vector<Trial::Timed>& faults) {
  BenchConfig c = Rehearsal::defaultConfig();
  for (const Trial::Timed& t : faults) {
    const auto& reasons = t.fault->reasons;
    if (std::find(reasons.begin(), reasons.end(), BenchFault::kPositionLimit) != reasons.end()) {
      c.drives[3].limits.position_high = kTrialAngleLimit;
    }
  }
  return c;
}

}  // namespace

int Trial::boundOf(const FaultCase& fault) {
  // Off: the decision, and the ramp of the drive's own stop. Damped: its time comes on top.
  const int damping = Rehearsal::defaultConfig().safety.damping_cycles;
  return fault.detection_cycles + 1 + (fault.reaction == Reaction::kDampThenOff ? damping : 1) +
         fault.way_down_cycles;
}

Trial::Trial(std::vector<Timed> faults, RunnerKind kind)
    : faults_(std::move(faults)), rehearsal_(configOf(faults_), kind) {
  for (const Timed& t : faults_) longest_ = std::max(longest_, t.at_cycle + boundOf(*t.fault));
}

// Every drive's torque changes all the time, and no two alike.
Turn Trial::turnOf(int cycle) const {
  Turn turn;
  const double phase = kTwoPi * kCommandFrequency * 0.0025 * cycle;
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    turn.command.torque[i] = kCommandTorque * (1 + std::sin(phase + 0.5 * static_cast<double>(i)));
  }
  return turn;
}

bool Trial::begin(FaultRow& row) {
  if (!rehearsal_.engage()) {
    row.reason = "could not be engaged: " + rehearsal_.why();
    return false;
  }
  for (; cycles_ < kWarmUpCycles; ++cycles_) {
    const Turn turn = turnOf(cycles_);
    rehearsal_.cycle(&turn.command);
  }
  if (rehearsal_.ended() || !rehearsal_.torque().torqueOn()) {
    row.reason = "lost its torque before the fault: " + rehearsal_.why();
    return false;
  }
  return true;
}

// A robot that moves is not engaged: the drives wait, ready, and the fault comes then.
void Trial::runWhileReady() {
  rehearsal_.drives().inject({0, EmulatedFault::kRunaway, 5, 0.5});
  int syncs = 0;
  rehearsal_.wire(0).beforeSend([this, syncs](const CanFrame& f) mutable {
    if (f.id != 0x080) return;
    rehearsal_.torque().onCycleEnd();
    if (++syncs != kReadySyncs) return;
    rehearsal_.torque().begin();
    for (const Timed& t : faults_) t.fault->start(rehearsal_);
  });
  rehearsal_.engage();
}

void Trial::runCycles() {
  rehearsal_.torque().begin();
  const bool stepped = rehearsal_.kind() == RunnerKind::kStepped;
  const int last = longest_ + (stepped ? kAfterwards : kAfterwardsInLockstep);
  for (int n = 1; n <= last; ++n, ++cycles_) {
    bool without_master = false;
    Turn turn = turnOf(cycles_);
    for (const Timed& t : faults_) {
      if (n == t.at_cycle + 1 && t.fault->start) t.fault->start(rehearsal_);
      if (n <= t.at_cycle) continue;
      if (t.fault->each) t.fault->each(rehearsal_, turn, n - t.at_cycle);
      without_master = without_master || t.fault->without_master;
    }
    if (without_master) {
      rehearsal_.cycleWithoutMaster();
    } else {
      rehearsal_.cycle(turn.silent ? nullptr : &turn.command);
    }
    damped_ = damped_ || rehearsal_.bench().safety().action() == SafetyAction::kDamp;
  }
}

void Trial::conclude(FaultRow& row) {
  rehearsal_.finish();
  const TorqueWatch& torque = rehearsal_.torque();
  const Bench& bench = rehearsal_.bench();
  row.torque_on = rehearsal_.torque().torqueOn();
  row.measured_cycles = row.torque_on ? -1 : torque.offSince();
  row.says_off = bench.torqueIsOff();
  row.exit_code = static_cast<int>(rehearsal_.exitCode());
  row.check = checkOf(bench.safety().fault()).name;
  row.reason = bench.safety().state() == SafetyState::kFault ? bench.faultText()
                                                             : toText(bench.safety().state());
}

FaultRow Trial::run() {
  FaultRow row;
  row.runner = rehearsal_.kind();
  row.bound_cycles = longest_;
  row.measured_cycles = -1;
  row.torque_on = true;
  if (faults_.front().fault->while_ready) {
    runWhileReady();
  } else {
    if (!begin(row)) return row;
    runCycles();
  }
  conclude(row);
  return row;
}

}  // namespace ballbot
