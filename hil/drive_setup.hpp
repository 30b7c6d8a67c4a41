#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/sdo_client.hpp"

namespace ballbot {

/// Product codes (1018:02) of the emulator's nodes.
constexpr std::int64_t kEmulatedDrive = 0xBA11, kEmulatedImu = 0xBA12;
/// Vendor-ID 0 belongs to nobody: emulated devices have it, with products of a range.
constexpr bool isEmulatedDevice(std::int64_t vendor, std::int64_t product) noexcept {
  return vendor == 0 && product >= 0xBA10 && product <= 0xBA1F;
}

/// One SDO transfer of a node's set-up, and what must come of it.
struct SetupStep {
  enum class Kind {
    kWrite,       ///< write `value`; read `check` back and compare
    kExpect,      ///< read; must be `value`
    kExpectBits,  ///< read; must have these bits
    kAtLeast,     ///< read; must not be below
  };
  Kind kind = Kind::kWrite;
  ObjectAddress object, check;
  std::uint8_t size = 4;
  std::int64_t value = 0;
  const char* what = "";  ///< for messages: "rated torque"
  bool watched = false;   ///< read back again and again while the bench runs
};

/// What a drive is asked and told before it may have torque: it is the drive that was configured,
/// it can do what is needed, its PDOs are remapped (by the rules of CiA 301), its own limits and
/// its watch over the master are set.
std::vector<SetupStep> driveSetup(const BenchConfig& bench, const DriveConfig& drive);
/// The same for the IMU.
std::vector<SetupStep> imuSetup(const BenchConfig& bench);
/// What the IMU sends in one frame of CAN FD: the two PDOs it is delivered with, one after the
/// other.
PdoMapping imuMapping();

}  // namespace ballbot
