#include "hil/bench_master.hpp"

#include <algorithm>

#include "hil/shared_outputs.hpp"

namespace ballbot {
namespace {

// The IMU's frames: acceleration and counter, rates; one after the other in CAN FD's only one.
constexpr std::uint8_t kAccelBytes = 8, kGyroBytes = 6;

/// Number of the TPDO a frame is for `node`, or -1.
int tpdoOf(const CanFrame& f, int node) noexcept {
  if (f.extended || f.remote) return -1;
  for (std::size_t i = 0; i < kCobTpdo.size(); ++i) {
    if (f.id == kCobTpdo[i] + static_cast<std::uint32_t>(node)) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

bool isMasters(const BenchConfig& config, int bus, const CanFrame& f) noexcept {
  if (f.extended || f.remote) return false;
  if (f.id == kCobNmt || f.id == kCobSync) return true;
  const auto node = static_cast<int>(f.id & 0x7FU);
  const std::uint32_t function = f.id & 0x780U;
  if (function == kCobHeartbeat) return node == config.master_node;
  const bool commands = function == kCobSdoToServer ||
                        std::find(kCobRpdo.begin(), kCobRpdo.end(), function) != kCobRpdo.end();
  if (!commands) return false;
  if (node == config.imu.node && bus == config.imu.bus) return true;
  return std::any_of(config.drives.begin(), config.drives.end(),
                     [&](const DriveConfig& d) { return d.node == node && d.bus == bus; });
}

BenchMaster::BenchMaster(const BenchConfig& config)
    : config_(config),
      all_imu_pdos_(config.flexible() ? 0b01 : 0b11),
      outbox_(config.buses.size()) {
  const int sdo = config.cyclesOf(config.sdo_timeout_ms);
  for (const DriveConfig& d : config.drives) {
    links_.emplace_back(d.node, driveSetup(config, d), sdo, config.safety.heartbeat_cycles);
  }
  for (std::size_t i = 0; i < outbox_.size(); ++i) {
    outbox_[i].setFlexible(config.buses[i].settings.flexible());
  }
  links_.emplace_back(config.imu.node, imuSetup(config), sdo, config.safety.heartbeat_cycles);
  status_ = findInput({0x6041, 0});
  torque_ = findInput({0x6077, 0});
  position_ = findInput({0x6064, 0});
  velocity_ = findInput({0x606C, 0});
  motor_position_ = findInput({0x60E4, 1});
  demand_ = findInput({0x6074, 0});
  if (config.shared_outputs) {
    for (int bus = 0; bus < busCount(); ++bus) {
      shared_frames_.push_back(sharedFrame(config, bus));
    }
    for (std::size_t i = 0; i < kDriveCount; ++i) {
      shared_at_[i] = sharedOffset(config, config.drives[i]);
    }
  }
  current_ = findInput({0x6078, 0});
  heartbeat_period_ = std::max(
      1, static_cast<int>(std::chrono::milliseconds(config.master_heartbeat_ms) / config.cycle));
}

BenchMaster::Input BenchMaster::findInput(ObjectAddress object) const noexcept {
  for (std::size_t i = 0; i < config_.inputs.size(); ++i) {
    if (const PdoField field = config_.inputs[i].find(object)) {
      return {field, static_cast<std::uint8_t>(i)};
    }
  }
  return {};
}

void BenchMaster::pushAll(const CanFrame& frame) noexcept {
  for (FrameQueue& queue : outbox_) queue.push(frame);
}

void BenchMaster::reset() noexcept {
  running_ = false;
  for (NodeLink& link : links_) link.expectBootUp(config_.cyclesOf(config_.boot_timeout_ms));
  pushAll(nmtFrame(NmtCommand::kResetNode, 0));
}

bool BenchMaster::configured() const noexcept {
  return std::all_of(links_.begin(), links_.end(), [](const NodeLink& link) {
    return link.phase() == NodeLink::Phase::kConfigured;
  });
}

void BenchMaster::start() noexcept {
  for (NodeLink& link : links_) link.start();
  pushAll(nmtFrame(NmtCommand::kStart, 0));
  foreign_.reset();
  imu_misses_.clear();
  for (Drive& d : drives_) {
    d.misses.clear();
    d.twins.clear();
  }
  owed_ = {};
  running_ = true;
}

void BenchMaster::beginCycle() noexcept {
  ++cycle_;
  collecting_ = true;
  pdos_seen_ = {};
  twin_seen_ = {};
  imu_seen_ = 0;
  if (!running_) return;
  if (cycle_ % heartbeat_period_ == 0) {
    pushAll(heartbeatFrame(config_.master_node, NmtState::kOperational));
  }
  pushAll(syncFrame());
}

void BenchMaster::onFrame(int bus, const CanFrame& frame) noexcept {
  // A bus does not give a node's own frames back to it.
  if (running_ && isMasters(config_, bus, frame)) {
    foreign_ = frame;
    return;
  }
  FrameQueue& out = outbox(bus);
  for (int i = 0; i < kDriveCount; ++i) {
    const DriveConfig& d = config_.drives[static_cast<std::size_t>(i)];
    if (d.bus != bus) continue;
    if (links_[static_cast<std::size_t>(i)].onFrame(frame, out)) return;
    const int pdo = tpdoOf(frame, d.node);
    if (pdo >= 0) return readPdo(i, pdo, frame);
  }
  if (config_.imu.bus != bus || links_[kImuLink].onFrame(frame, out)) return;
  const int pdo = tpdoOf(frame, config_.imu.node);
  if (pdo >= 0) readImu(pdo, frame);
}

// An adapter that stalled gives the answers of several cycles at once: they are no twin's.
bool BenchMaster::settle(std::size_t drive, int pdo) noexcept {
  int& owed = owed_[drive][static_cast<std::size_t>(pdo)];
  if (owed == 0) return false;
  --owed;
  return true;
}

void BenchMaster::readPdo(int i, int pdo, const CanFrame& frame) noexcept {
  const auto n = static_cast<std::size_t>(i);
  if (!running_) return;
  if (!collecting_) {
    ++late_pdos_;
    settle(n, pdo);
    return;
  }
  if (static_cast<std::size_t>(pdo) >= config_.inputs.size() ||
      frame.size != config_.inputs[static_cast<std::size_t>(pdo)].frameBytes()) {
    ++bad_pdos_;  // counts as missing
    return;
  }
  const DriveScaling& scale = config_.drives[n].scaling;
  const auto in = [&](const Input& input) { return input.field && input.pdo == pdo; };
  if (in(status_))
    drives_[n].statusword = static_cast<std::uint16_t>(status_.field.getUnsigned(frame));
  if (in(torque_)) sample_.joint_torque[n] = scale.torque(torque_.field.getSigned(frame));
  if (in(position_)) sample_.joint_angle[n] = scale.angle(position_.field.getSigned(frame));
  if (in(velocity_)) sample_.joint_velocity[n] = scale.velocity(velocity_.field.getSigned(frame));
  if (in(demand_)) drives_[n].demand = demand_.field.getSigned(frame);
  if (in(current_)) sample_.motor_torque[n] = scale.motorTorque(current_.field.getSigned(frame));
  if (in(motor_position_)) {
    sample_.motor_angle[n] = scale.motorAngle(motor_position_.field.getSigned(frame));
  }
  if ((pdos_seen_[n] & 1U << pdo) != 0 && !settle(n, pdo)) twin_seen_[n] = true;
  pdos_seen_[n] = static_cast<std::uint8_t>(pdos_seen_[n] | 1U << pdo);
}

void BenchMaster::readImu(int pdo, const CanFrame& frame) noexcept {
  const bool whole = config_.flexible();
  if (!running_ || pdo >= (whole ? 1 : 2)) return;
  if (!collecting_) {
    ++late_pdos_;
    return;
  }
  const std::uint8_t expected = pdo == 1 ? kGyroBytes
                                : whole
                                    ? kFlexibleSizes[flexibleLengthCode(kAccelBytes + kGyroBytes)]
                                    : kAccelBytes;
  if (frame.size != expected) {
    ++bad_pdos_;
    return;
  }
  const auto readAxes = [&](std::size_t at, double unit, std::array<double, 3>& axes) {
    for (std::size_t i = 0; i < 3; ++i) {
      axes[i] = static_cast<double>(getSigned(&frame.data[at + 2 * i], 2)) * unit;
    }
  };
  if (pdo == 0) {
    readAxes(0, config_.imu.accel_resolution, sample_.accel);
    imu_pending_counter_ = static_cast<std::uint16_t>(getLittleEndian(&frame.data[6], 2));
  }
  if (pdo == 1 || whole) {
    readAxes(whole ? kAccelBytes : 0, config_.imu.gyro_resolution, sample_.gyro);
  }
  imu_seen_ = static_cast<std::uint8_t>(imu_seen_ | 1U << pdo);
}

bool BenchMaster::isAwaited() const noexcept {
  for (const NodeLink& link : links_) {
    if (link.awaitsAnswer()) return true;
  }
  if (!running_) return false;
  const auto all = static_cast<std::uint8_t>((1U << config_.inputs.size()) - 1);
  for (const std::uint8_t seen : pdos_seen_) {
    if (seen != all) return true;
  }
  return imu_seen_ != all_imu_pdos_;
}

void BenchMaster::endCycle() noexcept {
  collecting_ = false;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const int bus = i < kDriveCount ? config_.drives[i].bus : config_.imu.bus;
    links_[i].onCycle(outbox(bus));
  }
  if (!running_) return;
  const auto all = static_cast<std::uint8_t>((1U << config_.inputs.size()) - 1);
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    drives_[i].stale_cycles = pdos_seen_[i] == all ? 0 : drives_[i].stale_cycles + 1;
    drives_[i].misses.add(pdos_seen_[i] != all);
    drives_[i].twins.add(twin_seen_[i]);
    for (std::size_t p = 0; p < config_.inputs.size(); ++p) {
      int& owed = owed_[i][p];
      if ((pdos_seen_[i] & 1U << p) == 0 && owed < config_.safety.stale_cycles) ++owed;
    }
    if (!motor_position_.field) {
      sample_.motor_angle[i] = sample_.joint_angle[i] +
                               sample_.joint_torque[i] / config_.drives[i].scaling.spring_stiffness;
    }
  }
  sample_.cycle = cycle_;
  // A counter that stands still is an IMU that hangs, whatever it goes on sending.
  const auto grown = static_cast<std::uint16_t>(imu_pending_counter_ - imu_counter_);
  if (imu_seen_ == all_imu_pdos_ && grown != 0) {
    sample_.imu_count += sample_.imu_count == 0 ? 1 : grown;
    sample_.imu_cycle = cycle_;
    imu_counter_ = imu_pending_counter_;
    imu_stale_ = 0;
  } else {
    ++imu_stale_;
  }
  imu_misses_.add(imu_stale_ >= config_.imu.period_cycles);
}

void BenchMaster::setGoal(DriveGoal goal) noexcept {
  for (int i = 0; i < kDriveCount; ++i) setGoal(i, goal);
}
void BenchMaster::setGoal(int drive, DriveGoal goal) noexcept {
  drives_[static_cast<std::size_t>(drive)].power.setGoal(goal);
}
void BenchMaster::resetFault(int drive) noexcept {
  drives_[static_cast<std::size_t>(drive)].power.resetFault();
}

void BenchMaster::nmt(int drive, NmtCommand command) noexcept {
  const DriveConfig& d = config_.drives[static_cast<std::size_t>(drive)];
  outbox(d.bus).push(nmtFrame(command, d.node));
  links_[static_cast<std::size_t>(drive)].forgetQuestion();
}

bool BenchMaster::ask(int drive, ObjectAddress object, bool urgent) noexcept {
  const auto n = static_cast<std::size_t>(drive);
  return links_[n].ask(object, urgent, outbox(config_.drives[n].bus));
}

void BenchMaster::disableBySdo(int drive) noexcept {
  const auto n = static_cast<std::size_t>(drive);
  links_[n].tell({0x6040, 0}, kDisableVoltage, 2, outbox(config_.drives[n].bus));
}

bool BenchMaster::allDrives(DriveState state) const noexcept {
  return std::all_of(drives_.begin(), drives_.end(), [&](const Drive& d) {
    return d.stale_cycles == 0 && driveState(d.statusword) == state;
  });
}

void BenchMaster::writeOutputs(const BenchCommand& command) noexcept {
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    const DriveConfig& config = config_.drives[i];
    Drive& d = drives_[i];
    const std::uint16_t controlword =
        d.stale_cycles == 0 ? d.power.next(d.statusword) : d.power.hold();
    const bool enabled =
        controlword == kEnableOperation && d.power.state() == DriveState::kOperationEnabled;
    d.sent_torque = enabled ? config.scaling.torqueCounts(command.torque[i]) : 0;
    // A drive on its way up is told to stay where it is.
    const double angle = enabled ? command.position[i] : sample_.joint_angle[i];
    const double velocity = enabled ? command.velocity[i] : 0;
    for (std::size_t p = 0; p < config_.outputs.size(); ++p) {
      const PdoMapping& map = config_.outputs[p];
      CanFrame own;
      own.id = kCobRpdo[p] + static_cast<std::uint32_t>(config.node);
      own.size = map.frameBytes();
      const bool shared = config_.shared_outputs;
      CanFrame& frame = shared ? shared_frames_[static_cast<std::size_t>(config.bus)] : own;
      const auto put = [&](std::uint16_t index, std::int64_t value) {
        PdoField field = map.find({index, 0});
        if (!field) return;
        field.offset = static_cast<std::uint8_t>(field.offset + shared_at_[i]);
        field.put(frame, value);
      };
      put(0x6040, controlword);
      put(0x6071, d.sent_torque);
      put(0x60B2, d.sent_torque);
      put(0x607A, config.scaling.angleCounts(angle));
      put(0x60B1, config.scaling.velocityCounts(velocity));
      if (!shared) outbox(config.bus).push(frame);
    }
  }
  for (std::size_t bus = 0; bus < shared_frames_.size(); ++bus) {
    if (shared_frames_[bus].size > 0) outbox_[bus].push(shared_frames_[bus]);
  }
}

}  // namespace ballbot
