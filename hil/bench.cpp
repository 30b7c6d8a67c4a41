#include "hil/bench.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace ballbot {
namespace {

// Over this time a disagreement of position and velocity is forgotten [s].
constexpr double kMismatchMemory = 0.5;

Safety::Timing timingOf(const SafetyConfig& s) { return {s.damping_cycles, s.transition_cycles}; }

bool allFinite(const DriveArray& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

Bench::Bench(const BenchConfig& config)
    : config_(config),
      master_(config),
      safety_(timingOf(config.safety)) {}

// Of several faults in one cycle the gravest counts.
void Bench::notice(BenchFault fault, int drive, double value, double limit) noexcept {
  if (seen_.fault == BenchFault::kNone || (dampsFirst(seen_.fault) && !dampsFirst(fault))) {
    seen_ = {fault, drive, value, limit};
  }
}

void Bench::observe(int skipped_cycles) noexcept {
  seen_ = {};
  checkNetwork();
  checkDrives();
  checkMotion((1 + skipped_cycles) * config_.cycleSeconds());
}

// Without the IMU the drives can still brake the robot; without a drive they cannot.
void Bench::checkNetwork() noexcept {
  for (int i = 0; i <= kDriveCount; ++i) {
    if (master_.link(i).trouble() == NodeTrouble::kNone) continue;
    const bool only_imu =
        i == BenchMaster::kImuLink && master_.link(i).phase() == NodeLink::Phase::kRunning;
    notice(only_imu ? BenchFault::kImuStale : BenchFault::kNodeTrouble, i);
  }
}

void Bench::checkDrives() noexcept {
  for (int i = 0; i < kDriveCount; ++i) {
    const BenchMaster::Drive& d = master_.drive(i);
    if (d.stale_cycles >= config_.safety.stale_cycles) {
      notice(BenchFault::kDriveStale, i, d.stale_cycles, config_.safety.stale_cycles);
    }
    if (d.stale_cycles != 0) continue;
    const DriveState state = driveState(d.statusword);
    bool& enabled = was_enabled_[static_cast<std::size_t>(i)];
    const bool wanted =
        safety_.action() == SafetyAction::kFollow || safety_.action() == SafetyAction::kDamp;
    const bool faulty = state == DriveState::kFault || state == DriveState::kFaultReactionActive;
    // Faults from before are reset once when the drives are prepared; from then on they count.
    if (faulty && safety_.state() != SafetyState::kDisabled) {
      notice(BenchFault::kDriveFault, i, d.statusword);
    } else if (wanted && enabled && state != DriveState::kOperationEnabled) {
      notice(BenchFault::kDriveDroppedOut, i, d.statusword);
    }
    enabled = state == DriveState::kOperationEnabled;
  }
}

/// @param dt  since the cycle before [s]
void Bench::checkMotion(double dt) noexcept {
  const BenchSample& s = master_.sample();
  if (!allFinite(s.joint_angle) || !allFinite(s.joint_velocity) || !allFinite(s.joint_torque)) {
    notice(BenchFault::kSensorNotFinite);
  }
  if (s.imu_cycle == master_.cycle()) tilt_.update(dt, s.accel, s.gyro);
  const bool torque_on = safety_.state() == SafetyState::kEnabled;
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const DriveLimits& limits = config_.drives[n].limits;
    const bool fresh = master_.drive(i).stale_cycles == 0;
    const double step = s.joint_angle[n] - last_angle_[n];
    if (has_last_ && fresh && std::isfinite(step)) {
      mismatch_[n] += step - dt * s.joint_velocity[n];
      mismatch_[n] *= std::max(0.0, 1 - dt / kMismatchMemory);
    }
    // The first sample after missing ones has come further than one period's velocity says.
    last_angle_[n] = fresh ? s.joint_angle[n] : std::numeric_limits<double>::quiet_NaN();
    if (!torque_on) {
      mismatch_[n] = 0;
      continue;
    }
    if (std::abs(mismatch_[n]) > config_.safety.encoder_mismatch) {
      notice(BenchFault::kEncoderImplausible, i, mismatch_[n], config_.safety.encoder_mismatch);
    }
    if (std::abs(s.joint_velocity[n]) > limits.velocity) {
      notice(BenchFault::kVelocityLimit, i, s.joint_velocity[n], limits.velocity);
    }
    if (s.joint_angle[n] < limits.position_low || s.joint_angle[n] > limits.position_high) {
      const bool low = s.joint_angle[n] < limits.position_low;
      notice(BenchFault::kPositionLimit, i, s.joint_angle[n],
             low ? limits.position_low : limits.position_high);
    }
  }
  has_last_ = true;
  if (!torque_on) return;
  if (master_.imuStaleCycles() >= config_.safety.stale_cycles) {
    notice(BenchFault::kImuStale, -1, master_.imuStaleCycles(), config_.safety.stale_cycles);
  }
  if (tilt_.tilt() > config_.safety.tilt) {
    notice(BenchFault::kTiltLimit, -1, tilt_.tilt(), config_.safety.tilt);
  }
}

void Bench::checkCommand(const Wishes& w) noexcept {
  if (w.bus_down) notice(BenchFault::kBusDown);
  if (w.skipped_cycles >= config_.safety.late_cycles) {
    notice(BenchFault::kLateLoop, -1, w.skipped_cycles, config_.safety.late_cycles);
  }
  if (safety_.action() != SafetyAction::kFollow || w.stop) return;
  if (w.command_age > config_.safety.watchdog_cycles) {
    notice(BenchFault::kCommandTimeout, -1, w.command_age, config_.safety.watchdog_cycles);
  }
  if (w.command == nullptr) return;
  const BenchCommand& c = *w.command;
  if (!allFinite(c.torque) || !allFinite(c.position) || !allFinite(c.velocity) ||
      !allFinite(c.stiffness) || !allFinite(c.damping)) {
    return notice(BenchFault::kCommandNotFinite);
  }
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const DriveConfig& d = config_.drives[n];
    const bool in_drive = config_.mode == DriveMode::kPosition;
    // In torque mode the law may stay in the command: it is evaluated here, at bus rate.
    if (in_drive && (std::abs(c.stiffness[n] - d.stiffness) > 1e-9 ||
                     std::abs(c.damping[n] - d.damping) > 1e-9)) {
      notice(BenchFault::kCommandGains, i, c.stiffness[n], d.stiffness);
    }
  }
}

bool Bench::atRest() const noexcept {
  const BenchSample& s = master_.sample();
  if (tilt_.tilt() > config_.safety.tilt) return false;
  return std::all_of(s.joint_velocity.begin(), s.joint_velocity.end(),
                     [&](double v) { return std::abs(v) < config_.safety.rest_velocity; });
}

DriveGoal Bench::goalOf(SafetyAction action) const noexcept {
  switch (action) {
    case SafetyAction::kNoVoltage:
      return DriveGoal::kVoltageOff;
    case SafetyAction::kSwitchedOn:
      return DriveGoal::kSwitchedOn;
    case SafetyAction::kZeroTorque:
    case SafetyAction::kFollow:
    case SafetyAction::kDamp:
      return DriveGoal::kEnabled;
  }
  return DriveGoal::kVoltageOff;
}

void Bench::actuate(const Wishes& w) noexcept {
  checkCommand(w);
  const bool was_fault = safety_.state() == SafetyState::kFault;
  Safety::Events events;
  events.fault = seen_.fault;
  events.prepare = w.prepare;
  events.engage = w.engage;
  events.stop = w.stop;
  events.at_rest = atRest();
  events.drives_switched_on = master_.allDrives(DriveState::kSwitchedOn);
  events.drives_enabled = master_.allDrives(DriveState::kOperationEnabled);
  if (w.prepare && safety_.state() == SafetyState::kDisabled) resetOldFaults();
  const SafetyAction action = safety_.step(events);
  if (!was_fault && safety_.state() == SafetyState::kFault) {
    latched_ = seen_.fault == safety_.fault() ? seen_ : Seen{safety_.fault(), -1, 0, 0};
  }
  out_ = {};
  out_.position = master_.sample().joint_angle;
  if (action == SafetyAction::kFollow && w.command != nullptr) {
    follow(*w.command);
  } else if (action == SafetyAction::kDamp) {
    damp();
  } else {
    torque_ = {};
  }
  master_.setGoal(goalOf(action));
  master_.writeOutputs(out_);
}

// Once per drive, and only of faults that were there before anybody wanted torque.
void Bench::resetOldFaults() noexcept {
  for (int i = 0; i < kDriveCount; ++i) {
    bool& tried = reset_tried_[static_cast<std::size_t>(i)];
    if (tried || driveState(master_.drive(i).statusword) != DriveState::kFault) continue;
    tried = true;
    master_.resetFault(i);
  }
}

// Torque is cut to its rate, then to its limit, and grows from zero after engaging.
void Bench::follow(const BenchCommand& c) noexcept {
  const BenchSample& s = master_.sample();
  const int ramp = config_.safety.ramp_cycles;
  const double share =
      safety_.followed() + 1 < ramp ? static_cast<double>(safety_.followed() + 1) / ramp : 1.0;
  bool saturated = false;
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    const DriveLimits& limits = config_.drives[i].limits;
    double wanted = c.torque[i];
    if (config_.mode == DriveMode::kTorque) {
      wanted += c.stiffness[i] * (c.position[i] - s.joint_angle[i]) +
                c.damping[i] * (c.velocity[i] - s.joint_velocity[i]);
    }
    wanted *= share;
    const double step = limits.torque_rate * config_.cycleSeconds();
    const double given = std::clamp(std::clamp(wanted, torque_[i] - step, torque_[i] + step),
                                    -limits.torque, limits.torque);
    saturated = saturated || given != wanted;
    torque_[i] = given;
  }
  if (saturated) ++saturated_;
  out_.torque = torque_;
  if (config_.mode == DriveMode::kPosition) {
    // The drive's own loop is ramped by its set-points: from where the joint is to where it shall
    // be.
    for (std::size_t i = 0; i < kDriveCount; ++i) {
      out_.position[i] = s.joint_angle[i] + share * (c.position[i] - s.joint_angle[i]);
      out_.velocity[i] = share * c.velocity[i];
    }
  }
}

void Bench::damp() noexcept {
  const BenchSample& s = master_.sample();
  const double bound = config_.safety.damping_torque;
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    const double limit = std::min(bound, config_.drives[i].limits.torque);
    torque_[i] = std::clamp(-config_.safety.damping * s.joint_velocity[i], -limit, limit);
  }
  out_.torque = torque_;
}

CycleRecord Bench::record() const noexcept {
  CycleRecord r;
  r.cycle = master_.cycle();
  r.state = safety_.state();
  r.action = safety_.action();
  r.fault = safety_.fault();
  r.sample = master_.sample();
  r.torque = torque_;
  for (int i = 0; i < kDriveCount; ++i) {
    r.statusword[static_cast<std::size_t>(i)] = master_.drive(i).statusword;
  }
  return r;
}

std::string Bench::faultText() const {
  const BenchFault fault = safety_.fault();
  if (fault == BenchFault::kNone) return "";
  std::string text = toText(fault);
  if (latched_.drive >= 0 && latched_.drive < kDriveCount) {
    text += ": " + config_.drives[static_cast<std::size_t>(latched_.drive)].name;
  }
  switch (fault) {
    case BenchFault::kNodeTrouble:
      return text + (latched_.drive == BenchMaster::kImuLink ? ": IMU" : "") + ": " +
             master_.link(latched_.drive).troubleText();
    case BenchFault::kDriveFault:
    case BenchFault::kDriveDroppedOut: {
      const auto word = static_cast<std::uint16_t>(latched_.value);
      return fmt::format("{} ({}, statusword {:04X})", text, toText(driveState(word)), word);
    }
    case BenchFault::kDriveTransition:
    case BenchFault::kCommandNotFinite:
    case BenchFault::kSensorNotFinite:
    case BenchFault::kBusDown:
      return text;
    default:
      if (latched_.drive == BenchMaster::kImuLink) {
        return text + ": " + master_.link(latched_.drive).troubleText();
      }
      return fmt::format("{} ({:.4g}, limit {:.4g})", text, latched_.value, latched_.limit);
  }
}

}  // namespace ballbot
