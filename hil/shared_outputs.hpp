#pragma once

#include <cstdint>

#include "hil/bench_config.hpp"

namespace ballbot {

// Outputs of all drives of a bus in one RPDO, which every one of them receives: each maps its own
// bytes, and what CiA 301 calls dummies (a data type as an object) in place of the others'. A
// frame's head and tail are most of its time on CAN FD, so this is what makes room at high rates.

/// Whether an entry of a mapping is a dummy.
constexpr bool isDummy(ObjectAddress object) noexcept { return object.index <= 0x0007; }

/// Identifier of the shared RPDO of a bus: that of RPDO1 of its first drive.
std::uint32_t sharedIdentifier(const BenchConfig& config, int bus);

/// Where a drive's outputs begin in the shared RPDO of its bus [byte].
std::uint8_t sharedOffset(const BenchConfig& config, const DriveConfig& drive);

/// The shared RPDO as `drive` maps it.
PdoMapping sharedOutputs(const BenchConfig& config, const DriveConfig& drive);

/// The shared RPDO of a bus with all bytes zero; of size 0 if it has no drive.
CanFrame sharedFrame(const BenchConfig& config, int bus);

}  // namespace ballbot
