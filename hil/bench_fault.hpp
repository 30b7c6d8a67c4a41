#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ballbot {

/// What can end a run on the bench. `checkTable()` has a row for each.
enum class BenchFault : std::uint8_t {
  kNone,
  kCommandTimeout,
  kCommandNotFinite,
  kCommandGains,
  kCommandRepeats,
  kCommandOrder,
  kCommandAbsurd,
  kVelocityLimit,
  kPositionLimit,
  kTiltLimit,
  kImuStale,
  kLateLoop,
  kImuRepeats,
  kImuDisagrees,
  kDriveFault,
  kDriveDroppedOut,
  kDriveUnbidden,
  kDriveTransition,
  kDriveStale,
  kDriveMisses,
  kNodeTrouble,
  kNodeTwin,
  kForeignFrame,
  kParameterChanged,
  kEncoderImplausible,
  kPositionJump,
  kSpringDisagrees,
  kTorqueRepeats,
  kTorqueDiffers,
  kEchoDiffers,
  kSensorNotFinite,
  kBusDown,
};

/// What the bench does first when a check fires.
enum class FirstReaction : std::uint8_t {
  kNone,
  kDamp,  ///< bounded damping, then torque off: measurements and drives can still be trusted
  kOff,   ///< torque off in the same cycle, in all six
};

/// One check: the only place that holds its name, words, bound and page.
struct Check {
  BenchFault fault = BenchFault::kNone;
  const char* name = "";   ///< for programs: "torque_differs"
  const char* words = "";  ///< for people, first words of the message
  FirstReaction reaction = FirstReaction::kNone;
  /// With the settings of bench.yaml: cycles from the first frame that shows it to the decision.
  int bound_cycles = 0;
  const char* page = "";  ///< below docs/troubleshooting/
};

constexpr std::size_t kCheckCount = static_cast<std::size_t>(BenchFault::kBusDown) + 1;
/// All checks, in the order of the enum; the first row is that of no fault.
const std::array<Check, kCheckCount>& checkTable() noexcept;
const Check& checkOf(BenchFault fault) noexcept;

inline const char* toText(BenchFault fault) noexcept { return checkOf(fault).words; }
/// Whether the bench damps the robot's motion before it takes the torque away.
inline bool dampsFirst(BenchFault fault) noexcept {
  return checkOf(fault).reaction == FirstReaction::kDamp;
}

}  // namespace ballbot
