#include "hil/emulator/emulated_bench.hpp"

#include <algorithm>
#include <cmath>

#include "cosim/participant.hpp"
#include "hil/emulator/test_stand.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kRobotGrid = 100'000;  // the robot moves in steps of at least this [ns]
// Of real time at once: a machine too slow for its robot still answers, and falls behind.
constexpr std::int64_t kLongestStep = 10'000'000;
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
      stand_(dynamic_cast<TestStand*>(robot_.get())),
      imu_(std::make_unique<ImuNode>(config.imu_node, config.accel_resolution,
                                     config.gyro_resolution)),
      outbox_(static_cast<std::size_t>(config.bus_count)),
      pending_syncs_(outbox_.size()),
      frozen_(outbox_.size()),
      heard_(outbox_.size()),
      syncs_held_back_(outbox_.size()) {
  for (const EmulatedDriveParameters& p : config.drives) {
    drives_.push_back(std::make_unique<DriveNode>(p));
    drives_.back()->setFlexible(config.flexible);
  }
  imu_->setFlexible(config.flexible);
  robot_->enterInitializationMode(kSimStart);
  robot_->exitInitializationMode();
  for (int i = 0; stand_ != nullptr && i < 6; ++i) drive(i).setStand(stand_->output(i));
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

bool EmulatedBench::owesAnswer() const {
  return std::any_of(drives_.begin(), drives_.end(), [](const auto& d) { return d->owesAnswer(); });
}

void EmulatedBench::onFrame(int bus, const CanFrame& frame) {
  const auto b = static_cast<std::size_t>(bus);
  if (frozen_[b]) return;
  if (frame.flexible && !config_.flexible) return;  // a classic node destroys it
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
  if (grid > now_ns_) passTime(std::min(grid - now_ns_, kLongestStep));
}

void EmulatedBench::idle(std::int64_t elapsed_ns) {
  sync_is_clock_ = sync_is_clock_ && anyOperational();
  if (sync_is_clock_) return;
  idle_ns_ = std::min(idle_ns_ + elapsed_ns, kLongestStep);
  const std::int64_t step = idle_ns_ / kRobotGrid * kRobotGrid;
  idle_ns_ -= step;
  if (step > 0) passTime(step);
}

// Without SYNC. Where SYNC will be the clock, the robot stands still unless somebody drives it.
void EmulatedBench::passTime(std::int64_t step_ns) {
  now_ns_ += step_ns;
  const bool driven = std::any_of(drives_.begin(), drives_.end(),
                                  [](const auto& drive) { return drive->enabled(); });
  robot_runs_ = robot_runs_ || driven;
  if (driven || !config_.stepped) {
    moveRobot(step_ns);
    readRobot();
  } else {
    readOutputs();  // ramps of stops end
  }
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
  for (int i = 0; stand_ != nullptr && i < 6; ++i) {
    stand_->setOutput(i, drive(i).standOutput());
  }
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
        {s.joint_angle[i], s.motor_angle[i], velocity, s.joint_torque[i],
         stand_ != nullptr ? stand_->motorTorque(i) : 0});
  }
  std::array<double, 3> accel{s.accel_B[0], s.accel_B[1], s.accel_B[2]};
  if (const auto truth = robot_->truth(); truth && s.imu_count == 0) {
    accel = restForce(truth->state[kPitch], truth->state[kRoll]);
  }
  std::array<double, 3> gyro{s.gyro_WB_B[0], s.gyro_WB_B[1], s.gyro_WB_B[2]};
  if (lean_ != 0) {  // as if the base lay over to this angle and kept turning
    const std::array<double, 3> rest = restForce(-lean_, 0);
    accel = {rest[0] + accel[0], rest[1] + accel[1], rest[2]};
    gyro[1] -= 10;
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
  const auto drive = static_cast<std::size_t>(order.drive);
  const auto bus = static_cast<std::size_t>(config_.drive_bus[drive]);
  switch (order.kind) {
    case EmulatedFault::kRunaway:
      runaway_[order.drive] = order.value;
      break;
    case EmulatedFault::kFrozenBus:
      frozen_[bus] = true;
      break;
    case EmulatedFault::kSyncHeldBack:
      syncs_held_back_[bus] = static_cast<int>(order.value);
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
    default:
      injectInto(*drives_[drive], order);
  }
}

void EmulatedBench::injectInto(DriveNode& drive, const FaultOrder& order) {
  const auto code = static_cast<std::uint16_t>(order.value);
  switch (order.kind) {
    case EmulatedFault::kEmergency:
      return drive.raiseFault(code, code == 0x4310 ? 0x08 : code >> 12 == 3 ? 0x04 : 0x02);
    case EmulatedFault::kUnannouncedFault:
      collect();
      drive.raiseFault(code, 0);
      return drive.outbox().clear();
    case EmulatedFault::kHeartbeatLost:
      return drive.stopHeartbeat(true);
    case EmulatedFault::kPdosLost:
      return drive.dropPdos(true);
    case EmulatedFault::kPdosTruncated:
      return drive.truncatePdos(true);
    case EmulatedFault::kPowerLoss:
      return drive.powerOff();
    case EmulatedFault::kReboot:
      drive.powerOff();
      return drive.powerOn();
    case EmulatedFault::kNmtStop:
      return drive.forceNmt(0x02);
    case EmulatedFault::kNmtPreOperational:
      return drive.forceNmt(0x80);
    case EmulatedFault::kLocalDisable:
      return drive.localDisable();
    case EmulatedFault::kStatusword:
      return drive.freezeStatusword(code);
    case EmulatedFault::kStuckEncoder:
      return drive.sticking(true);
    case EmulatedFault::kPositionJump:
      return drive.shiftPosition(order.value);
    case EmulatedFault::kWarning:
      return drive.setWarning(true);
    default:  // of the bus, the IMU or the robot
      return;
  }
}

}  // namespace ballbot
