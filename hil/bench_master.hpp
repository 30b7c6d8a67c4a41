#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/bench_signals.hpp"
#include "hil/cia402.hpp"
#include "hil/doubt/miss_window.hpp"
#include "hil/frame_queue.hpp"
#include "hil/node_link.hpp"

namespace ballbot {

/// Whether only the master of a bench may send this frame: one that came is somebody else's.
bool isMasters(const BenchConfig& config, int bus, const CanFrame& frame) noexcept;

/// The CANopen master of the bench: six drives and the IMU on one or two buses. A pure state
/// machine that is driven cycle by cycle; after construction it neither allocates, locks nor
/// throws.
///
///   set-up:    reset(), then frames until nothing isAwaited(), endCycle() per cycle; start()
///   each cycle beginCycle(), frames until nothing isAwaited(), endCycle(), then writeOutputs()
///
/// What it has to send is in outbox(bus); whoever sends it empties it.
class BenchMaster {
 public:
  explicit BenchMaster(const BenchConfig& config);

  /// Resets all nodes; they boot and are configured.
  void reset() noexcept;
  bool configured() const noexcept;
  /// NMT start for all, from which on cycles run.
  void start() noexcept;

  /// SYNC on every bus, and the master's heartbeat when it is due.
  void beginCycle() noexcept;
  void onFrame(int bus, const CanFrame& frame) noexcept;
  /// Whether a node still owes an answer in this cycle.
  bool isAwaited() const noexcept;
  /// Counts what is missing.
  void endCycle() noexcept;

  /// Sends every drive its controlword on the way to its goal, and `command` to drives that are
  /// enabled; the others get zero.
  void writeOutputs(const BenchCommand& command) noexcept;
  void setGoal(DriveGoal goal) noexcept;
  void setGoal(int drive, DriveGoal goal) noexcept;
  /// One attempt to reset the fault that a drive has from before.
  void resetFault(int drive) noexcept;

  /// An NMT command to one drive alone, whose open question is forgotten.
  void nmt(int drive, NmtCommand command) noexcept;
  /// Asks a drive for an object by SDO; see NodeLink::ask().
  bool ask(int drive, ObjectAddress object, bool urgent) noexcept;
  /// Tells a drive "disable voltage" by SDO.
  void disableBySdo(int drive) noexcept;
  std::optional<NodeLink::Answer> takeAnswer(int drive) noexcept {
    return links_[static_cast<std::size_t>(drive)].takeAnswer();
  }

  FrameQueue& outbox(int bus) noexcept { return outbox_[static_cast<std::size_t>(bus)]; }
  int busCount() const noexcept { return static_cast<int>(outbox_.size()); }
  const BenchSample& sample() const noexcept { return sample_; }
  std::int64_t cycle() const noexcept { return cycle_; }

  struct Drive {
    std::uint16_t statusword = 0;
    int stale_cycles = 0;  ///< since the last complete set of its PDOs
    DrivePowerSequence power;
    std::int64_t sent_torque = 0;  ///< per mille
    std::int64_t demand = 0;       ///< 6074, per mille; 0 where it is not mapped
    MissWindow misses;             ///< cycles without a complete set
    MissWindow twins;              ///< cycles with a PDO too many
  };
  const Drive& drive(int i) const noexcept { return drives_[static_cast<std::size_t>(i)]; }
  const NodeLink& link(int i) const noexcept { return links_[static_cast<std::size_t>(i)]; }
  static constexpr int kImuLink = kDriveCount;
  /// Since a new IMU sample was due; 0 if none is overdue.
  int imuStaleCycles() const noexcept {
    return std::max(0, imu_stale_ - config_.imu.period_cycles + 1);
  }
  /// Cycles of the last ones without a new IMU sample.
  int imuMisses() const noexcept { return imu_misses_.count(); }
  bool allDrives(DriveState state) const noexcept;
  /// PDOs whose length is not that of their mapping.
  /// The last frame that only this master may send and somebody else did, since start().
  const std::optional<CanFrame>& foreignFrame() const noexcept { return foreign_; }
  std::int64_t badPdos() const noexcept { return bad_pdos_; }
  /// PDOs that came after their cycle had ended; they count as missing there and for nothing later.
  std::int64_t latePdos() const noexcept { return late_pdos_; }

 private:
  struct Input {
    PdoField field;
    std::uint8_t pdo = 0;
  };
  bool settle(std::size_t drive, int pdo) noexcept;
  void readPdo(int drive, int pdo, const CanFrame& frame) noexcept;
  void readImu(int pdo, const CanFrame& frame) noexcept;
  Input findInput(ObjectAddress object) const noexcept;
  void pushAll(const CanFrame& frame) noexcept;

  BenchConfig config_;
  std::vector<NodeLink> links_;
  std::array<Drive, kDriveCount> drives_;
  std::array<std::uint8_t, kDriveCount> pdos_seen_{};  ///< in this cycle, a bit each
  std::array<bool, kDriveCount> twin_seen_{};          ///< in this cycle
  /// PDOs that cycles before have missed and that may still come; as many as may be missing at
  /// most.
  std::array<std::array<int, 4>, kDriveCount> owed_{};
  std::optional<CanFrame> foreign_;
  std::uint8_t imu_seen_ = 0, all_imu_pdos_;
  int imu_stale_ = 0;
  MissWindow imu_misses_;
  std::uint16_t imu_counter_ = 0;
  std::uint16_t imu_pending_counter_ = 0;
  std::vector<CanFrame> shared_frames_;                ///< by bus, of shared outputs
  std::array<std::uint8_t, kDriveCount> shared_at_{};  ///< where a drive's outputs begin in them
  std::vector<FrameQueue> outbox_;
  BenchSample sample_;
  std::int64_t cycle_ = 0;
  bool running_ = false;
  int heartbeat_period_ = 1;
  bool collecting_ = false;  ///< between beginCycle() and endCycle()
  std::int64_t bad_pdos_ = 0, late_pdos_ = 0;
  Input status_, torque_, position_, velocity_, motor_position_, demand_, current_;
};

}  // namespace ballbot
