#include "hil/cia402.hpp"

namespace ballbot {
namespace {

struct Pattern {
  std::uint16_t mask, value;
  DriveState state;
};
// CiA 402-2, table of statusword bits.
constexpr Pattern kPatterns[] = {
    {0x4F, 0x00, DriveState::kNotReadyToSwitchOn},  {0x4F, 0x40, DriveState::kSwitchOnDisabled},
    {0x6F, 0x21, DriveState::kReadyToSwitchOn},     {0x6F, 0x23, DriveState::kSwitchedOn},
    {0x6F, 0x27, DriveState::kOperationEnabled},    {0x6F, 0x07, DriveState::kQuickStopActive},
    {0x4F, 0x0F, DriveState::kFaultReactionActive}, {0x4F, 0x08, DriveState::kFault},
};
// The reset bit is raised for so many statuswords; then the attempt counts as failed.
constexpr int kResetPatience = 8;

}  // namespace

const char* toText(DriveState state) noexcept {
  switch (state) {
    case DriveState::kNotReadyToSwitchOn:
      return "not ready to switch on";
    case DriveState::kSwitchOnDisabled:
      return "switch on disabled";
    case DriveState::kReadyToSwitchOn:
      return "ready to switch on";
    case DriveState::kSwitchedOn:
      return "switched on";
    case DriveState::kOperationEnabled:
      return "operation enabled";
    case DriveState::kQuickStopActive:
      return "quick stop active";
    case DriveState::kFaultReactionActive:
      return "fault reaction active";
    case DriveState::kFault:
      return "fault";
    case DriveState::kUnknown:
      break;
  }
  return "unknown";
}

DriveState driveState(std::uint16_t statusword) noexcept {
  for (const Pattern& p : kPatterns) {
    if ((statusword & p.mask) == p.value) return p.state;
  }
  return DriveState::kUnknown;
}

void DrivePowerSequence::setGoal(DriveGoal goal) noexcept {
  if (goal == goal_) return;
  goal_ = goal;
  waited_ = 0;
}

bool DrivePowerSequence::atGoal() const noexcept {
  switch (goal_) {
    case DriveGoal::kVoltageOff:
      return state_ == DriveState::kSwitchOnDisabled || state_ == DriveState::kFault;
    case DriveGoal::kSwitchedOn:
      return state_ == DriveState::kSwitchedOn;
    case DriveGoal::kEnabled:
      return state_ == DriveState::kOperationEnabled;
    case DriveGoal::kQuickStop:
      return state_ == DriveState::kQuickStopActive || state_ == DriveState::kSwitchOnDisabled;
  }
  return false;
}

std::uint16_t DrivePowerSequence::leaveFault() noexcept {
  switch (reset_) {
    case Reset::kNone:
      return kDisableVoltage;
    case Reset::kWanted:  // bit 7 low at least once, so that there is an edge
      reset_ = Reset::kLow;
      return kDisableVoltage;
    case Reset::kLow:
      reset_ = Reset::kHigh;
      waited_ = 0;
      return kFaultReset;
    case Reset::kHigh:
      if (waited_ >= kResetPatience) reset_ = Reset::kNone;
      return kFaultReset;
  }
  return kDisableVoltage;
}

std::uint16_t DrivePowerSequence::next(std::uint16_t statusword) noexcept {
  const DriveState now = driveState(statusword);
  waited_ = now == state_ ? waited_ + 1 : 0;
  state_ = now;
  if (now != DriveState::kFault && reset_ == Reset::kHigh) reset_ = Reset::kNone;
  last_ = now == DriveState::kFault ? leaveFault() : towardsGoal(now);
  return last_;
}

std::uint16_t DrivePowerSequence::hold() noexcept {
  const bool has_torque = last_ == kEnableOperation;
  if (goal_ == DriveGoal::kVoltageOff) last_ = kDisableVoltage;
  // To a drive without torque it is "disable voltage", so it may be said to one that is silent.
  if (goal_ == DriveGoal::kQuickStop) last_ = kQuickStopCommand;
  if (goal_ == DriveGoal::kSwitchedOn && has_torque) last_ = kSwitchOn;
  return last_;
}

std::uint16_t DrivePowerSequence::towardsGoal(DriveState now) noexcept {
  if (goal_ == DriveGoal::kVoltageOff) return kDisableVoltage;
  if (goal_ == DriveGoal::kQuickStop) {
    const bool moving = now == DriveState::kOperationEnabled || now == DriveState::kQuickStopActive;
    return moving ? kQuickStopCommand : kDisableVoltage;
  }
  switch (now) {
    case DriveState::kSwitchOnDisabled:
      return kShutdown;  // transition 2
    case DriveState::kReadyToSwitchOn:
      return kSwitchOn;  // 3
    case DriveState::kSwitchedOn:
    case DriveState::kOperationEnabled:
      return goal_ == DriveGoal::kEnabled ? kEnableOperation : kSwitchOn;  // 4, or 5 back
    default:  // quick stop, fault reaction, not ready, unknown: nothing may follow but no voltage
      return kDisableVoltage;
  }
}

}  // namespace ballbot
