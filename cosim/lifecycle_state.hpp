#pragma once

#include <cstdint>

namespace ballbot {

/// Where a participant, or an instance of the plant's FMU, stands in the life that FMI gives it.
enum class LifecycleState : std::uint8_t {
  kInstantiated,
  kInitialization,
  kStep,
  kTerminated,
  kFailed,  ///< a call threw; only reset and restoreState lead out
};

constexpr const char* toText(LifecycleState state) {
  switch (state) {
    case LifecycleState::kInstantiated:
      return "instantiated";
    case LifecycleState::kInitialization:
      return "initialization";
    case LifecycleState::kStep:
      return "step";
    case LifecycleState::kTerminated:
      return "terminated";
    case LifecycleState::kFailed:
      return "failed";
  }
  return "unknown";
}

}  // namespace ballbot
