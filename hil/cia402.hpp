#pragma once

#include <cstdint>

namespace ballbot {

// CiA 402 (IEC 61800-7-201): the power state machine of a drive, as its master sees it.

enum class DriveState : std::uint8_t {
  kNotReadyToSwitchOn,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
  kUnknown,  ///< a statusword that no state has
};
const char* toText(DriveState state) noexcept;

/// State that a statusword (6041) shows.
DriveState driveState(std::uint16_t statusword) noexcept;

// Other bits of the statusword.
constexpr std::uint16_t kStatusVoltage = 1U << 4, kStatusWarning = 1U << 7, kStatusRemote = 1U << 9,
                        kStatusInternalLimit = 1U << 11, kStatusFollowsCommand = 1U << 12;

// Values of the controlword (6040).
constexpr std::uint16_t kDisableVoltage = 0x00, kQuickStopCommand = 0x02, kShutdown = 0x06,
                        kSwitchOn = 0x07, kEnableOperation = 0x0F, kFaultReset = 0x80;

// Modes of operation (6060, 6061), and their bits in 6502.
constexpr std::int8_t kModeCyclicPosition = 8, kModeCyclicTorque = 10;
constexpr std::uint32_t supportedModeBit(std::int8_t mode) { return 1U << (mode - 1); }

/// Where a drive shall be.
enum class DriveGoal : std::uint8_t {
  kVoltageOff,  ///< switch on disabled: no power in the motor
  kSwitchedOn,  ///< ready to go, no torque
  kEnabled,     ///< operation enabled
  kQuickStop,   ///< the drive's own stop (605A), then whatever that leads to
};

/// Walks one drive to its goal, one transition per statusword that confirms the one before. Faults
/// are left alone unless a reset is asked for, and a reset is one rising edge of bit 7.
class DrivePowerSequence {
 public:
  void setGoal(DriveGoal goal) noexcept;
  DriveGoal goal() const noexcept { return goal_; }
  /// One attempt to leave the fault state.
  void resetFault() noexcept { reset_ = Reset::kWanted; }
  bool resetPending() const noexcept { return reset_ != Reset::kNone; }

  /// The controlword to send after this statusword.
  std::uint16_t next(std::uint16_t statusword) noexcept;
  /// The controlword to send where no statusword came: the last one, since nothing confirms a step
  /// further up; but a goal further down counts at once.
  std::uint16_t hold() noexcept;
  bool atGoal() const noexcept;
  DriveState state() const noexcept { return state_; }
  /// Statuswords since the state or the goal last changed: how long a transition is taking.
  int waited() const noexcept { return waited_; }

 private:
  enum class Reset : std::uint8_t { kNone, kWanted, kLow, kHigh };
  std::uint16_t leaveFault() noexcept;
  std::uint16_t towardsGoal(DriveState now) noexcept;

  DriveGoal goal_ = DriveGoal::kVoltageOff;
  DriveState state_ = DriveState::kUnknown;
  Reset reset_ = Reset::kNone;
  int waited_ = 0;
  std::uint16_t last_ = kDisableVoltage;  ///< controlword given out last
};

}  // namespace ballbot
