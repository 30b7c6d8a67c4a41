#include "hil/safety.hpp"

namespace ballbot {

const char* toText(SafetyState state) noexcept {
  switch (state) {
    case SafetyState::kDisabled:
      return "disabled";
    case SafetyState::kReady:
      return "ready";
    case SafetyState::kEnabled:
      return "enabled";
    case SafetyState::kFault:
      return "fault";
  }
  return "unknown";
}

const char* toText(SafetyAction action) noexcept {
  switch (action) {
    case SafetyAction::kNoVoltage:
      return "no_voltage";
    case SafetyAction::kSwitchedOn:
      return "switched_on";
    case SafetyAction::kZeroTorque:
      return "zero_torque";
    case SafetyAction::kFollow:
      return "follow";
    case SafetyAction::kDamp:
      return "damp";
  }
  return "";
}

SafetyAction Safety::step(const Events& events) noexcept {
  action_ = decide(events);
  return action_;
}

// The first fault is kept as the reason; a graver one still ends the damping of a milder one.
void Safety::latch(BenchFault fault) noexcept {
  const bool had_torque = state_ == SafetyState::kEnabled;
  if (state_ != SafetyState::kFault) {
    fault_ = fault;
    damping_left_ = had_torque && !engaging_ ? timing_.damping_cycles : 0;
    state_ = SafetyState::kFault;
  }
  if (!dampsFirst(fault)) damping_left_ = 0;
}

SafetyAction Safety::decide(const Events& e) noexcept {
  // An arm that sinks into its limit while the bench stops asks for what is being done already.
  const bool under_way = stopping_ && state_ == SafetyState::kEnabled && dampsFirst(e.fault);
  if (e.fault != BenchFault::kNone && !under_way) latch(e.fault);
  switch (state_) {
    case SafetyState::kFault:
      return damping_left_-- > 0 ? SafetyAction::kDamp : SafetyAction::kNoVoltage;
    case SafetyState::kDisabled:
      if (!e.prepare || e.stop) {
        waited_ = 0;
        return SafetyAction::kNoVoltage;
      }
      if (e.drives_switched_on) {
        state_ = SafetyState::kReady;
        waited_ = 0;
      } else if (++waited_ > timing_.transition_cycles) {
        latch(BenchFault::kDriveTransition);
        return SafetyAction::kNoVoltage;
      }
      return SafetyAction::kSwitchedOn;
    case SafetyState::kReady:
      if (e.stop) {
        state_ = SafetyState::kDisabled;
        return SafetyAction::kNoVoltage;
      }
      engage_refused_ = e.engage && !e.at_rest;
      if (!e.engage || engage_refused_) return SafetyAction::kSwitchedOn;
      state_ = SafetyState::kEnabled;
      engaging_ = true;
      stopping_ = false;
      waited_ = followed_ = 0;
      return SafetyAction::kZeroTorque;
    case SafetyState::kEnabled:
      break;
  }
  if (e.stop && !stopping_) {
    stopping_ = true;
    damping_left_ = engaging_ ? 0 : timing_.damping_cycles;
  }
  if (stopping_) {
    if (damping_left_-- > 0) return SafetyAction::kDamp;
    state_ = SafetyState::kDisabled;
    waited_ = 0;
    return SafetyAction::kNoVoltage;
  }
  if (engaging_) {
    if (e.drives_enabled) {
      engaging_ = false;
      return SafetyAction::kFollow;
    }
    if (++waited_ <= timing_.transition_cycles) return SafetyAction::kZeroTorque;
    latch(BenchFault::kDriveTransition);
    return SafetyAction::kNoVoltage;
  }
  ++followed_;
  return SafetyAction::kFollow;
}

}  // namespace ballbot
