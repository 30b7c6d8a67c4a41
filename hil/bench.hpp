#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/bench_master.hpp"
#include "hil/bench_signals.hpp"
#include "hil/safety.hpp"
#include "hil/tilt_monitor.hpp"

namespace ballbot {

/// One cycle of the bench as numbers, for the record.
struct CycleRecord {
  std::int64_t cycle = 0;
  SafetyState state = SafetyState::kDisabled;
  SafetyAction action = SafetyAction::kNoVoltage;
  BenchFault fault = BenchFault::kNone;
  BenchSample sample;
  DriveArray torque{};  ///< sent [N m]
  std::array<std::uint16_t, kDriveCount> statusword{};
  std::int32_t wake_late_ns = 0, act_late_ns = 0;  ///< of the real-time loop
};

/// The bench: master, limits and safety together, one cycle at a time. Pure like its parts; the
/// clock and the buses are around it (BenchIo, RealtimeLoop).
class Bench {
 public:
  explicit Bench(const BenchConfig& config);

  BenchMaster& master() noexcept { return master_; }
  const BenchMaster& master() const noexcept { return master_; }
  const Safety& safety() const noexcept { return safety_; }
  const BenchConfig& config() const noexcept { return config_; }

  /// What the world asks of the bench; read in every actuate().
  struct Wishes {
    bool prepare = false;  ///< drives may be switched on
    bool engage = false;   ///< torque wanted
    bool stop = false;     ///< end of session, or Ctrl-C
    bool bus_down = false;
    int skipped_cycles = 0;  ///< in a row, by a loop that was late
    /// Cycles since the command below was given; a new one has 0.
    int command_age = 0;
    const BenchCommand* command = nullptr;  ///< null: none yet
  };

  /// After the frames of a cycle came: judges what was measured.
  /// @param skipped_cycles  that a late loop left out since the one before
  void observe(int skipped_cycles = 0) noexcept;
  /// Decides and fills the master's outbox.
  void actuate(const Wishes& wishes) noexcept;

  /// Torque as it was last sent, SI [N m].
  const DriveArray& torque() const noexcept { return torque_; }
  double tilt() const noexcept { return tilt_.tilt(); }
  bool atRest() const noexcept;
  CycleRecord record() const noexcept;

  /// The latched fault in words, with drive, value and limit.
  std::string faultText() const;
  std::int64_t saturatedCycles() const noexcept { return saturated_; }

 private:
  void notice(BenchFault fault, int drive = -1, double value = 0, double limit = 0) noexcept;
  void checkNetwork() noexcept;
  void checkDrives() noexcept;
  void checkMotion(double dt) noexcept;
  void checkCommand(const Wishes& wishes) noexcept;
  void follow(const BenchCommand& command) noexcept;
  void damp() noexcept;
  void resetOldFaults() noexcept;
  DriveGoal goalOf(SafetyAction action) const noexcept;

  BenchConfig config_;
  BenchMaster master_;
  Safety safety_;
  TiltMonitor tilt_;
  BenchCommand out_;
  DriveArray torque_{};
  DriveArray last_angle_{}, mismatch_{};
  bool has_last_ = false;
  std::int64_t saturated_ = 0;
  // The first fault seen in this cycle, and the one that was latched.
  struct Seen {
    BenchFault fault = BenchFault::kNone;
    int drive = -1;
    double value = 0, limit = 0;
  };
  Seen seen_, latched_;
  std::array<bool, kDriveCount> was_enabled_{};
  std::array<bool, kDriveCount> reset_tried_{};  ///< of faults from before
};

}  // namespace ballbot
