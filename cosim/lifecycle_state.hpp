#pragma once

#include <cstddef>
#include <cstdint>

namespace ballbot {

/// Where one that is stepped (cosim/stepped.hpp), or an instance of the plant's FMU, stands in the
/// life that FMI gives it.
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

/// Calls that are not allowed in every state.
enum class LifecycleCall : std::uint8_t {
  kEnterInitializationMode,
  kExitInitializationMode,
  kDoStep,
  kTerminate,
  kRead,  ///< of what comes out
  kSaveState,
  kRestoreState,
};

constexpr const char* toText(LifecycleCall call) {
  constexpr const char* kNames[] = {"enterInitializationMode",
                                    "exitInitializationMode",
                                    "doStep",
                                    "terminate",
                                    "reading sensors, truth or digest",
                                    "saveState",
                                    "restoreState"};
  return kNames[static_cast<std::size_t>(call)];
}

constexpr bool allows(LifecycleState state, LifecycleCall call) {
  using S = LifecycleState;
  switch (call) {
    case LifecycleCall::kEnterInitializationMode:
      return state == S::kInstantiated;
    case LifecycleCall::kExitInitializationMode:
      return state == S::kInitialization;
    case LifecycleCall::kDoStep:
    case LifecycleCall::kTerminate:
      return state == S::kStep;
    case LifecycleCall::kRead:
      return state == S::kStep || state == S::kTerminated;
    case LifecycleCall::kSaveState:
      return state == S::kInitialization || state == S::kStep || state == S::kTerminated;
    case LifecycleCall::kRestoreState:
      return state != S::kInstantiated;
  }
  return false;
}

}  // namespace ballbot
