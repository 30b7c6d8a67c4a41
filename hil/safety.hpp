#pragma once

#include <cstdint>

#include "hil/bench_fault.hpp"

namespace ballbot {

enum class SafetyState : std::uint8_t {
  kDisabled,  ///< no voltage
  kReady,     ///< drives switched on, no torque
  kEnabled,   ///< torque
  kFault,     ///< latched until the process ends: there is no automatic restart
};
const char* toText(SafetyState state) noexcept;

/// What the drives shall do in a cycle.
enum class SafetyAction : std::uint8_t {
  kNoVoltage,
  kSwitchedOn,
  kZeroTorque,  ///< enabled, no torque: engaging
  kFollow,      ///< the controller's command, within limits
  kDamp,        ///< bounded damping, no command
};

const char* toText(SafetyAction action) noexcept;

/// Decides once per cycle what the drives do. Pure: no clock, no bus.
class Safety {
 public:
  struct Timing {
    int damping_cycles = 1;
    int transition_cycles = 1;  ///< for all drives to follow
  };
  struct Events {
    BenchFault fault = BenchFault::kNone;  ///< the gravest one seen in this cycle
    bool prepare = false;                  ///< drives are configured and shall be switched on
    bool engage = false;                   ///< somebody wants torque
    bool stop = false;                     ///< the session ended, or a person stopped it
    bool at_rest = false;
    bool drives_switched_on = false;  ///< all six
    bool drives_enabled = false;      ///< all six
  };

  explicit Safety(Timing timing) : timing_(timing) {}

  SafetyAction step(const Events& events) noexcept;

  SafetyState state() const noexcept { return state_; }
  SafetyAction action() const noexcept { return action_; }
  /// Why it is in fault.
  BenchFault fault() const noexcept { return fault_; }
  /// Cycles since torque followed the controller's command for the first time; 0 in that cycle.
  int followed() const noexcept { return followed_; }
  /// The last engage was refused because the robot moved.
  bool engageRefused() const noexcept { return engage_refused_; }

 private:
  SafetyAction decide(const Events& events) noexcept;
  void latch(BenchFault fault) noexcept;

  Timing timing_;
  SafetyState state_ = SafetyState::kDisabled;
  SafetyAction action_ = SafetyAction::kNoVoltage;
  BenchFault fault_ = BenchFault::kNone;
  bool engaging_ = false, stopping_ = false, engage_refused_ = false;
  int waited_ = 0, damping_left_ = 0, followed_ = 0;
};

}  // namespace ballbot
