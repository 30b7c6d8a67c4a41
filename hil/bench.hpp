#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/bench_master.hpp"
#include "hil/bench_signals.hpp"
#include "hil/doubt/command_doubt.hpp"
#include "hil/doubt/drive_doubt.hpp"
#include "hil/doubt/finding.hpp"
#include "hil/doubt/imu_doubt.hpp"
#include "hil/doubt/parameter_watch.hpp"
#include "hil/safety.hpp"
#include "hil/tilt_monitor.hpp"
#include "hil/way_down.hpp"

namespace ballbot {

/// One cycle of the bench as numbers, for the record.
struct CycleRecord {
  std::int64_t cycle = 0;
  std::int64_t time_ns = 0;  ///< bus time of its SYNC; see FlightRecorder::timeNs()
  SafetyState state = SafetyState::kDisabled;
  SafetyAction action = SafetyAction::kNoVoltage;
  BenchFault fault = BenchFault::kNone;
  BenchSample sample;
  DriveArray asked{};   ///< by the controller, before rate, limit and ramp [N m]
  DriveArray torque{};  ///< sent [N m]
  std::array<std::uint16_t, kDriveCount> statusword{};
  std::array<std::uint8_t, kDriveCount> stale{};   ///< cycles since a drive's PDOs were complete
  std::uint8_t imu_stale = 0;                      ///< cycles since the last new sample
  std::uint8_t skipped = 0;                        ///< periods left out before this cycle
  float tilt = 0;                                  ///< [rad]
  std::int32_t wake_late_ns = 0, act_late_ns = 0;  ///< of the real-time loop
};

/// The bench: master, limits and safety together, one cycle at a time. Pure like its parts; the
/// clock and the buses are around it (BenchIo, RealtimeLoop).
class Bench {
 public:
  explicit Bench(const BenchConfig& config);
  Bench(const Bench&) = delete;  // its parts point at its configuration
  Bench& operator=(const Bench&) = delete;

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
    int skipped_cycles = 0;                 ///< in a row, by a loop that was late
    const BenchCommand* command = nullptr;  ///< null: none yet
    /// Grows with every new command; one that stays the same grows old.
    std::int64_t command_number = 0;
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

  const WayDown& wayDown() const noexcept { return way_down_; }
  /// Nobody has asked for torque yet, or every drive has said that it is off again.
  bool torqueIsOff() const noexcept {
    return safety_.action() == SafetyAction::kNoVoltage &&
           (!way_down_.underWay() || way_down_.confirmed());
  }
  /// The torque is off, or all has been done that can be done by wire.
  bool isDown() const noexcept {
    return safety_.action() == SafetyAction::kNoVoltage &&
           (!way_down_.underWay() || way_down_.over());
  }
  const DriveDoubt& driveDoubt(int i) const {
    return drive_doubts_.at(static_cast<std::size_t>(i));
  }
  const ParameterWatch& parameters() const noexcept { return parameters_; }
  int commandAge() const noexcept { return command_doubt_.age(); }

  /// What the checks found in this cycle, and the one that is latched.
  const FindingList& findings() const noexcept { return findings_; }
  const Finding& latched() const noexcept { return latched_; }
  /// What a check found, in words.
  std::string textOf(const Finding& found) const;
  /// The latched fault in words, with drive, value and limit.
  std::string faultText() const;
  /// What a person must know and do where drives have not said that they are off: one sentence for
  /// each, with its node and its switch; "" if there is none.
  std::string lastWord() const;
  std::int64_t saturatedCycles() const noexcept { return saturated_; }

 private:
  void notice(BenchFault fault, int drive = -1, double value = 0, double limit = 0) noexcept;
  void notice(const Finding& found) noexcept;
  void checkNetwork() noexcept;
  void checkDrives() noexcept;
  void checkMotion() noexcept;
  void checkImu(double dt) noexcept;
  void checkMeasurements(int elapsed) noexcept;
  void checkParameters() noexcept;
  void askForParameter() noexcept;
  void checkCommand(const Wishes& wishes) noexcept;
  void follow(const BenchCommand& command) noexcept;
  void damp() noexcept;
  void goDown(bool had_torque) noexcept;
  void checkWayDown() noexcept;
  void resetOldFaults() noexcept;
  DriveGoal goalOf(SafetyAction action) const noexcept;

  BenchConfig config_;
  BenchMaster master_;
  Safety safety_;
  WayDown way_down_;
  CommandDoubt command_doubt_;
  std::vector<DriveDoubt> drive_doubts_;
  ImuDoubt imu_doubt_;
  ParameterWatch parameters_;
  int asked_drive_ = -1;  ///< owes the answer to a question of parameters_
  int since_question_ = 0;
  TiltMonitor tilt_;
  BenchCommand out_;
  DriveArray torque_{}, asked_{};
  std::int64_t saturated_ = 0;
  Finding seen_, latched_;  ///< the gravest of this cycle, and the one that was latched
  FindingList findings_;
  int skipped_ = 0;  ///< periods before this cycle
  std::array<bool, kDriveCount> was_enabled_{};
  std::array<int, kDriveCount> unbidden_{};      ///< cycles with torque that nobody asked for
  std::array<bool, kDriveCount> reset_tried_{};  ///< of faults from before
};

}  // namespace ballbot
