#pragma once

#include <array>
#include <cstdint>

#include "hil/bench_signals.hpp"
#include "hil/cia402.hpp"

namespace ballbot {

/// Takes the torque from six drives and believes no drive that has not said so itself. Pure: no
/// clock, no bus; one step() per cycle once torque shall be off.
///
///   disable voltage -> quick stop -> disable voltage -> NMT stop -> given up
///
/// After NMT stop it is told "disable voltage" once more, by SDO: one that was stopped already has
/// heard nothing of the rest. Each stage lasts `patience` cycles, the last one ten times as long. A
/// drive that says by statusword that it is off goes no further; one that says later that it is on
/// begins again.
class WayDown {
 public:
  enum class Stage : std::uint8_t { kDisable, kQuickStop, kDisableAgain, kNmtStop, kGivenUp };

  /// What a drive has said in this cycle.
  enum class Said : std::uint8_t {
    kNothing,  ///< no statusword came
    kOff,
    kOn,  ///< it has torque, or may have it at once
  };
  /// Off is a state without power in the motor: not "switched on", not a stop under way.
  static Said saidBy(DriveState state) noexcept;

  /// What a drive is to be told in this cycle.
  struct Order {
    DriveGoal goal = DriveGoal::kVoltageOff;
    bool nmt_stop = false;             ///< once
    bool nmt_pre_operational = false;  ///< once, after it: only there can it be asked by SDO
    bool disable_by_sdo = false;       ///< once, after that
    bool ask = false;                  ///< for its statusword, by SDO
  };

  explicit WayDown(int patience_cycles) : patience_(patience_cycles) {}

  /// Torque was on, or may have been: everything begins anew.
  void begin() noexcept;
  /// Torque is wanted again.
  void end() noexcept { under_way_ = false; }
  bool underWay() const noexcept { return under_way_; }

  void step(const std::array<Said, kDriveCount>& said) noexcept;
  const Order& order(int drive) const noexcept { return legs_[index(drive)].order; }

  /// Every drive has said that it is off.
  bool confirmed() const noexcept;
  /// Confirmed, or everything has been tried.
  bool over() const noexcept;
  /// This drive has not said that it is off.
  bool isDoubtful(int drive) const noexcept { return under_way_ && !legs_[index(drive)].off; }
  Stage stage(int drive) const noexcept { return legs_[index(drive)].stage; }
  /// Cycles after which it is over at the latest.
  int longest() const noexcept { return 3 * patience_ + kLastStage * patience_ + 2; }

 private:
  static constexpr int kLastStage = 10;  // an SDO may take its time
  static std::size_t index(int drive) noexcept { return static_cast<std::size_t>(drive); }
  struct Leg {
    Stage stage = Stage::kDisable;
    int waited = 0;
    bool off = false;
    Order order;
  };
  void step(Leg& leg, Said said) const noexcept;

  int patience_;
  bool under_way_ = false;
  std::array<Leg, kDriveCount> legs_{};
};

/// The last thing it was told: "quick stop".
const char* toText(WayDown::Stage stage) noexcept;

}  // namespace ballbot
