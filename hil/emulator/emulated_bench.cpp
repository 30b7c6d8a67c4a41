#include "hil/emulator/emulated_bench.hpp"

#include <algorithm>
#include <cmath>

#include "cosim/participant.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kRobotGrid = 100'000;  // the robot moves in steps of at least this [ns]
constexpr double kGravity = 9.81;

/// What an accelerometer in the base feels while it stands still: R_WB^T (0, 0, g).
std::array<double, 3> restForce(double pitch, double roll) {
  return {-kGravity * std::sin(pitch), kGravity * std::cos(pitch) * std::sin(roll),
          kGravity * std::cos(pitch) * std::cos(roll)};
}

}  // namespace

EmulatedBench::EmulatedBench(const EmulatorConfig& config, std::unique_ptr<Participant> robot)
    : config_(config),
      robot_(std::move(robot)),
      imu_(std::make_unique<ImuNode>(config.imu_node, config.accel_resolution,
                                     config.gyro_resolution)),
      outbox_(static_cast<std::size_t>(config.bus_count)),
      pending_syncs_(outbox_.size()),
      frozen_(outbox_.size()),
      heard_(outbox_.size()),
      syncs_held_back_(outbox_.size()) {
  for (const EmulatedDriveParameters& p : config.drives) {
    drives_.push_back(std::make_unique<DriveNode>(p));
  }
  robot_->enterInitializationMode(kSimStart);
  robot_->exitInitializationMode();
  readRobot();
}

EmulatedBench::~EmulatedBench() = default;

void EmulatedBench::powerOn() {
  for (auto& drive : drives_) drive->powerOn();
  imu_->powerOn();
  collect();
}

double EmulatedBench::robotSeconds() const { return 1e-9 * static_cast<double>(robot_ns_); }

bool EmulatedBench::anyEnergized() const {
  return std::any_of(drives_.begin(), drives_.end(), [](const auto& d) { return d->energized(); });
}

void EmulatedBench::onFrame(int bus, const CanFrame& frame) {
  const auto b = static_cast<std::size_t>(bus);
  if (frozen_[b]) return;
  heard_[b] = true;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (config_.drive_bus[i] == bus) drives_[i]->onFrame(frame);
  }
  if (config_.imu_bus == bus) imu_->onFrame(frame);
  collect();
  const bool sync = frame.id == 0x080 && frame.size == 0 && !frame.extended && !frame.remote;
  if (!sync) return;
  if (!config_.stepped) {
    if (bus == 0) {
      ++syncs_;
      if (!robot_runs_) ++idle_syncs_;
      for (const FaultOrder& order : config_.faults) {
        if (order.at_cycle == syncs_) inject(order);
      }
    }
    readRobot();
    sampleBus(bus);
    collect();
    return;
  }
  ++pending_syncs_[b];
  syncAll();
}

// A bus nobody ever spoke on has no master whose SYNC could be missing.
bool EmulatedBench::busIsNeeded(int bus) const {
  const auto b = static_cast<std::size_t>(bus);
  return heard_[b] && !frozen_[b];
}

// One cycle of stepped time, once every bus that still works has seen its SYNC.
void EmulatedBench::syncAll() {
  for (int b = 0; b < config_.bus_count; ++b) {
    if (busIsNeeded(b) && pending_syncs_[static_cast<std::size_t>(b)] == 0) return;
  }
  std::fill(pending_syncs_.begin(), pending_syncs_.end(), 0);
  startSyncClock();
  ++syncs_;
  for (const FaultOrder& order : config_.faults) {
    if (order.at_cycle == syncs_) inject(order);
  }
  const std::int64_t step = config_.cycle.count();
  now_ns_ += step;
  if (!robot_runs_) ++idle_syncs_;
  moveRobot(step);
  readRobot();
  // Who watches the master speaks first; then everybody answers the SYNC. So whatever belongs to a
  // cycle comes before the last answer that a master waits for.
  tellTime();
  for (int b = 0; b < config_.bus_count; ++b) sampleBus(b);
  collect();
}

void EmulatedBench::advanceTo(std::int64_t now_ns) {
  const std::int64_t grid = now_ns / kRobotGrid * kRobotGrid;
  if (grid <= now_ns_) return;
  const std::int64_t step = grid - now_ns_;
  now_ns_ = grid;
  moveRobot(step);
  tellTime();
}

void EmulatedBench::idle(std::int64_t elapsed_ns) {
  sync_is_clock_ = sync_is_clock_ && anyOperational();
  if (sync_is_clock_) return;
  now_ns_ += elapsed_ns;
  readOutputs();  // ramps of stops end, but the robot's time is that of SYNC alone
  tellTime();
}

// What wall time has left in the nodes' timers must not show in what follows.
void EmulatedBench::startSyncClock() {
  if (sync_is_clock_) return;
  sync_is_clock_ = true;
  for (auto& drive : drives_) drive->restartTimers();
  imu_->restartTimers();
}

bool EmulatedBench::anyOperational() const {
  return imu_->operational() || std::any_of(drives_.begin(), drives_.end(),
                                            [](const auto& d) { return d->operational(); });
}

void EmulatedBench::tellTime() {
  for (auto& drive : drives_) drive->onTime(now_ns_);
  imu_->onTime(now_ns_);
  collect();
}

ActuatorCommand EmulatedBench::readOutputs() {
  ActuatorCommand command;
  largest_torque_ = 0;
  for (int i = 0; i < 6; ++i) {
    const DriveOutput out = drives_[static_cast<std::size_t>(i)]->output(now_ns_);
    command.torque[i] = out.torque;
    command.position[i] = out.position;
    command.velocity[i] = out.velocity;
    command.stiffness[i] = out.stiffness;
    command.damping[i] = out.damping;
    largest_torque_ = std::max(largest_torque_, std::abs(out.torque));
  }
  return command;
}

void EmulatedBench::moveRobot(std::int64_t step_ns) {
  const ActuatorCommand command = readOutputs();
  if (!robot_runs_) return;
  robot_->doStep(simTimeFromNs(robot_ns_), SimDuration{step_ns}, command);
  robot_ns_ += step_ns;
  if (const auto truth = robot_->truth()) {
    largest_tilt_ = std::max(largest_tilt_, std::hypot(truth->state[kPitch], truth->state[kRoll]));
  }
}

void EmulatedBench::readRobot() {
  const SensorFrame& s = robot_->sensors();
  for (int i = 0; i < 6; ++i) {
    const double velocity = runaway_[i] != 0 ? runaway_[i] : s.joint_velocity[i];
    drives_[static_cast<std::size_t>(i)]->setFeedback(
        {s.joint_angle[i], s.motor_angle[i], velocity, s.joint_torque[i]});
  }
  std::array<double, 3> accel{s.accel_B[0], s.accel_B[1], s.accel_B[2]};
  if (const auto truth = robot_->truth(); truth && s.imu_count == 0) {
    accel = restForce(truth->state[kPitch], truth->state[kRoll]);
  }
  std::array<double, 3> gyro{s.gyro_WB_B[0], s.gyro_WB_B[1], s.gyro_WB_B[2]};
  if (lean_ != 0) {  // as if the base lay over to this angle and kept turning
    accel = restForce(-lean_, 0);
    gyro = {0, -10, 0};
  }
  // An IMU samples while the robot still stands, too.
  imu_->setSample(s.imu_count + idle_syncs_, accel, gyro);
}

bool EmulatedBench::holdBackSync(int bus) {
  int& left = syncs_held_back_[static_cast<std::size_t>(bus)];
  if (left == 0) return false;
  --left;
  return true;
}

void EmulatedBench::sampleBus(int bus) {
  if (holdBackSync(bus)) return;
  bool enabled = false;  // as reported, so before outputs of this SYNC act
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (config_.drive_bus[i] != bus) continue;
    enabled = enabled || drives_[i]->enabled();
    drives_[i]->onSync();
  }
  if (config_.imu_bus == bus) imu_->onSync();
  robot_runs_ = robot_runs_ || enabled;
}

// From the nodes' outboxes to those of their buses, in the order of the nodes.
void EmulatedBench::collect() {
  const auto move = [&](CanopenNode& node, int bus) {
    auto& out = outbox_[static_cast<std::size_t>(bus)];
    if (!frozen_[static_cast<std::size_t>(bus)]) {
      out.insert(out.end(), node.outbox().begin(), node.outbox().end());
    }
    node.outbox().clear();
  };
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    move(*drives_[i], config_.drive_bus[i]);
  }
  move(*imu_, config_.imu_bus);
}

void EmulatedBench::inject(const FaultOrder& order) {
  DriveNode& drive = *drives_[static_cast<std::size_t>(order.drive)];
  const auto code = static_cast<std::uint16_t>(order.value);
  switch (order.kind) {
    case EmulatedFault::kEmergency:
      drive.raiseFault(code, code == 0x4310 ? 0x08 : code >> 12 == 3 ? 0x04 : 0x02);
      break;
    case EmulatedFault::kUnannouncedFault:
      collect();
      drive.raiseFault(code, 0);
      drive.outbox().clear();
      break;
    case EmulatedFault::kHeartbeatLost:
      drive.stopHeartbeat(true);
      break;
    case EmulatedFault::kPdosLost:
      drive.dropPdos(true);
      break;
    case EmulatedFault::kPdosTruncated:
      drive.truncatePdos(true);
      break;
    case EmulatedFault::kPowerLoss:
      drive.powerOff();
      break;
    case EmulatedFault::kReboot:
      drive.powerOff();
      drive.powerOn();
      break;
    case EmulatedFault::kNmtStop:
      drive.forceNmt(0x02);
      break;
    case EmulatedFault::kNmtPreOperational:
      drive.forceNmt(0x80);
      break;
    case EmulatedFault::kLocalDisable:
      drive.localDisable();
      break;
    case EmulatedFault::kStatusword:
      drive.freezeStatusword(code);
      break;
    case EmulatedFault::kStuckEncoder:
      drive.sticking(true);
      break;
    case EmulatedFault::kPositionJump:
      drive.shiftPosition(order.value);
      break;
    case EmulatedFault::kRunaway:
      runaway_[order.drive] = order.value;
      break;
    case EmulatedFault::kFrozenBus:
      frozen_[static_cast<std::size_t>(config_.drive_bus[static_cast<std::size_t>(order.drive)])] =
          true;
      break;
    case EmulatedFault::kSyncHeldBack:
      syncs_held_back_[static_cast<std::size_t>(
          config_.drive_bus[static_cast<std::size_t>(order.drive)])] =
          static_cast<int>(order.value);
      break;
    case EmulatedFault::kImuLost:
      imu_->powerOff();
      break;
    case EmulatedFault::kImuFrozen:
      imu_->freeze(true);
      break;
    case EmulatedFault::kTilt:
      lean_ = order.value;
      break;
    case EmulatedFault::kWarning:
      drive.setWarning(true);
      break;
  }
}

}  // namespace ballbot
