#include "hil/bench.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

// From a goal below "enabled" to the statusword that shows it, and one to spare.
constexpr int kUnbiddenCycles = 3;
constexpr int kTwinCycles = 2;  // of the last 32
constexpr ObjectAddress kStatuswordObject{0x6041, 0};

Safety::Timing timingOf(const SafetyConfig& s) { return {s.damping_cycles, s.transition_cycles}; }

bool allFinite(const DriveArray& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::uint8_t upTo255(int count) noexcept {
  return static_cast<std::uint8_t>(std::clamp(count, 0, 255));
}

std::vector<std::vector<SetupStep>> setupsOf(const BenchConfig& config) {
  std::vector<std::vector<SetupStep>> setups;
  for (const DriveConfig& drive : config.drives) setups.push_back(driveSetup(config, drive));
  return setups;
}

}  // namespace

Bench::Bench(const BenchConfig& config)
    : config_(config),
      master_(config),
      safety_(timingOf(config.safety)),
      way_down_(config.safety.confirm_cycles),
      command_doubt_(config_),
      imu_doubt_(config_),
      parameters_(setupsOf(config)) {
  for (int i = 0; i < kDriveCount; ++i) drive_doubts_.emplace_back(config_, i);
}

// Of several faults in one cycle the gravest counts.
void Bench::notice(const Finding& found) noexcept {
  if (!found) return;
  findings_.push(found);
  if (!seen_ || (dampsFirst(seen_.fault) && !dampsFirst(found.fault))) seen_ = found;
}

void Bench::notice(BenchFault fault, int drive, double value, double limit) noexcept {
  notice(Finding{fault, drive, value, limit});
}

void Bench::observe(int skipped_cycles) noexcept {
  seen_ = {};
  findings_.clear();
  skipped_ = skipped_cycles;
  checkNetwork();
  checkDrives();
  checkMeasurements(1 + skipped_cycles);
  checkImu(std::max(1 + skipped_cycles, config_.imu.period_cycles) * config_.cycleSeconds());
  checkMotion();
  checkParameters();
}

// Without the IMU the drives can still brake the robot; without a drive they cannot.
void Bench::checkNetwork() noexcept {
  if (master_.foreignFrame()) {
    notice(BenchFault::kForeignFrame, -1, static_cast<double>(master_.foreignFrame()->id));
  }
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
    if (d.misses.count() >= config_.safety.most_misses) {
      notice(BenchFault::kDriveMisses, i, d.misses.count(), config_.safety.most_misses);
    }
    if (d.twins.count() >= kTwinCycles) notice(BenchFault::kNodeTwin, i);
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
    const bool bidden = d.power.goal() == DriveGoal::kEnabled || way_down_.underWay();
    int& unbidden = unbidden_[static_cast<std::size_t>(i)];
    unbidden =
        WayDown::saidBy(state) == WayDown::Said::kOn && !bidden && state != DriveState::kSwitchedOn
            ? unbidden + 1
            : 0;
    if (unbidden >= kUnbiddenCycles) notice(BenchFault::kDriveUnbidden, i, d.statusword);
  }
}

// Whatever is doubted is not used to brake with either: torque off.
void Bench::checkMeasurements(int elapsed) noexcept {
  const BenchSample& s = master_.sample();
  const bool torque_on = safety_.action() == SafetyAction::kZeroTorque ||
                         safety_.action() == SafetyAction::kFollow ||
                         safety_.action() == SafetyAction::kDamp;
  if (!allFinite(s.joint_angle) || !allFinite(s.joint_velocity) || !allFinite(s.joint_torque) ||
      !allFinite(s.motor_angle)) {
    notice(BenchFault::kSensorNotFinite);
  }
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const BenchMaster::Drive& d = master_.drive(i);
    DriveSeen seen;
    seen.fresh = d.stale_cycles == 0;
    seen.elapsed = elapsed;
    seen.angle = s.joint_angle[n];
    seen.motor_angle = s.motor_angle[n];
    seen.velocity = s.joint_velocity[n];
    seen.torque = s.joint_torque[n];
    seen.demand = d.demand;
    seen.enabled = driveState(d.statusword) == DriveState::kOperationEnabled;
    if (torque_on) {
      notice(drive_doubts_[n].check(seen, d.sent_torque));
    } else {
      drive_doubts_[n].rest(seen);
    }
  }
}

/// @param dt  since the sample before, if none is missing [s]
void Bench::checkImu(double dt) noexcept {
  const BenchSample& s = master_.sample();
  const bool fresh = s.imu_cycle == master_.cycle();
  if (fresh) tilt_.update(dt, s.accel, s.gyro);
  if (safety_.state() != SafetyState::kEnabled) return imu_doubt_.rest();
  if (fresh) notice(imu_doubt_.check(dt, s.accel, s.gyro, tilt_.up()));
  if (master_.imuStaleCycles() >= config_.safety.stale_cycles) {
    notice(BenchFault::kImuStale, -1, master_.imuStaleCycles(), config_.safety.stale_cycles);
  } else if (master_.imuMisses() >= config_.safety.most_misses) {
    notice(BenchFault::kImuStale, -1, master_.imuMisses(), config_.safety.most_misses);
  }
  if (tilt_.tilt() > config_.safety.tilt) {
    notice(BenchFault::kTiltLimit, -1, tilt_.tilt(), config_.safety.tilt);
  }
}

void Bench::checkMotion() noexcept {
  if (safety_.state() != SafetyState::kEnabled) return;
  const BenchSample& s = master_.sample();
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const DriveLimits& limits = config_.drives[n].limits;
    if (std::abs(s.joint_velocity[n]) > limits.velocity) {
      notice(BenchFault::kVelocityLimit, i, s.joint_velocity[n], limits.velocity);
    }
    if (s.joint_angle[n] < limits.position_low || s.joint_angle[n] > limits.position_high) {
      const bool low = s.joint_angle[n] < limits.position_low;
      notice(BenchFault::kPositionLimit, i, s.joint_angle[n],
             low ? limits.position_low : limits.position_high);
    }
  }
}

void Bench::checkParameters() noexcept {
  if (asked_drive_ < 0 || way_down_.underWay()) return;
  const auto answer = master_.takeAnswer(asked_drive_);
  if (!answer) return;
  asked_drive_ = -1;
  notice(parameters_.onAnswer(answer->given, answer->value));
}

// After the commands of a cycle, where the bus has nothing else to do.
void Bench::askForParameter() noexcept {
  if (config_.safety.read_back_cycles == 0 || asked_drive_ >= 0 || way_down_.underWay()) return;
  if (++since_question_ < config_.safety.read_back_cycles) return;
  since_question_ = 0;
  const ParameterWatch::Question question = parameters_.next();
  if (question.drive < 0) return;
  if (master_.ask(question.drive, question.object, false)) asked_drive_ = question.drive;
}

void Bench::checkCommand(const Wishes& w) noexcept {
  if (w.bus_down) notice(BenchFault::kBusDown);
  if (w.skipped_cycles >= config_.safety.late_cycles) {
    notice(BenchFault::kLateLoop, -1, w.skipped_cycles, config_.safety.late_cycles);
  }
  if (safety_.action() != SafetyAction::kFollow || w.stop) return command_doubt_.rest();
  notice(command_doubt_.check(w.command, w.command_number));
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
  checkWayDown();
  const bool had_torque = safety_.action() != SafetyAction::kNoVoltage;
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
    latched_ = seen_.fault == safety_.fault() ? seen_ : Finding{safety_.fault()};
  }
  out_ = {};
  asked_ = {};
  out_.position = master_.sample().joint_angle;
  if (action == SafetyAction::kFollow && w.command != nullptr) {
    follow(*w.command);
  } else if (action == SafetyAction::kDamp) {
    damp();
  } else {
    torque_ = {};
  }
  master_.setGoal(goalOf(action));
  if (action == SafetyAction::kNoVoltage) {
    goDown(had_torque);
  } else {
    way_down_.end();
  }
  master_.writeOutputs(out_);
  askForParameter();
}

// A drive that needs more than being told "disable voltage" ends the run as a fault.
void Bench::checkWayDown() noexcept {
  for (int i = 0; i < kDriveCount; ++i) {
    if (!way_down_.isDoubtful(i) || way_down_.stage(i) == WayDown::Stage::kDisable) continue;
    notice(BenchFault::kDriveTransition, i, master_.drive(i).statusword);
  }
}

void Bench::goDown(bool had_torque) noexcept {
  std::array<WayDown::Said, kDriveCount> said{};
  bool any_on = false;
  for (int i = 0; i < kDriveCount; ++i) {
    const BenchMaster::Drive& d = master_.drive(i);
    WayDown::Said& word = said[static_cast<std::size_t>(i)];
    if (d.stale_cycles == 0) word = WayDown::saidBy(driveState(d.statusword));
    any_on = any_on || (word == WayDown::Said::kOn && d.statusword != 0);
  }
  if (had_torque || (any_on && !way_down_.underWay())) way_down_.begin();
  if (!way_down_.underWay()) return;
  for (int i = 0; i < kDriveCount; ++i) {
    const auto answer = master_.takeAnswer(i);
    WayDown::Said& word = said[static_cast<std::size_t>(i)];
    if (!answer || !answer->given || word != WayDown::Said::kNothing) continue;
    if (answer->object == kStatuswordObject) {
      word = WayDown::saidBy(driveState(static_cast<std::uint16_t>(answer->value)));
    }
  }
  way_down_.step(said);
  for (int i = 0; i < kDriveCount; ++i) {
    const WayDown::Order& order = way_down_.order(i);
    master_.setGoal(i, order.goal);
    if (order.nmt_stop) master_.nmt(i, NmtCommand::kStop);
    if (order.nmt_pre_operational) master_.nmt(i, NmtCommand::kPreOperational);
    if ((order.nmt_stop || order.nmt_pre_operational) && asked_drive_ == i) asked_drive_ = -1;
    if (order.disable_by_sdo) master_.disableBySdo(i);
    if (order.ask) master_.ask(i, kStatuswordObject, true);
  }
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
    asked_[i] = wanted;
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
  r.asked = asked_;
  r.torque = torque_;
  for (int i = 0; i < kDriveCount; ++i) {
    const BenchMaster::Drive& d = master_.drive(i);
    r.statusword[static_cast<std::size_t>(i)] = d.statusword;
    r.stale[static_cast<std::size_t>(i)] = upTo255(d.stale_cycles);
  }
  r.imu_stale = upTo255(master_.imuStaleCycles());
  r.skipped = upTo255(skipped_);
  r.tilt = static_cast<float>(tilt_.tilt());
  return r;
}

}  // namespace ballbot
