#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hil/can_frame.hpp"

namespace ballbot {

// CiA 301 as the master writes and reads it: identifiers of the predefined connection set, network
// management, heartbeat, SYNC and emergency. All numbers are little endian on the wire.

constexpr int kNodeIdMin = 1, kNodeIdMax = 127;

constexpr std::uint32_t kCobNmt = 0x000;
constexpr std::uint32_t kCobSync = 0x080;
constexpr std::uint32_t kCobEmergency = 0x080;                                   ///< + node
constexpr std::array<std::uint32_t, 4> kCobTpdo = {0x180, 0x280, 0x380, 0x480};  ///< + node
constexpr std::array<std::uint32_t, 4> kCobRpdo = {0x200, 0x300, 0x400, 0x500};  ///< + node
constexpr std::uint32_t kCobSdoToClient = 0x580, kCobSdoToServer = 0x600;        ///< + node
constexpr std::uint32_t kCobHeartbeat = 0x700;                                   ///< + node

enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

enum class NmtState : std::uint8_t {
  kBootUp = 0x00,
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7F,
};
const char* toText(NmtState state) noexcept;

/// @param node 0 for all nodes.
CanFrame nmtFrame(NmtCommand command, int node) noexcept;
CanFrame syncFrame() noexcept;
CanFrame heartbeatFrame(int node, NmtState state) noexcept;

struct Heartbeat {
  int node;
  NmtState state;
};
/// Nothing if the frame is no heartbeat, or one of an unknown state.
std::optional<Heartbeat> readHeartbeat(const CanFrame& frame) noexcept;

struct Emergency {
  int node;
  std::uint16_t code;           ///< 0: no error any more
  std::uint8_t error_register;  ///< object 1001
  std::array<std::uint8_t, 5> vendor;
};
std::optional<Emergency> readEmergency(const CanFrame& frame) noexcept;
/// What an emergency code or an entry of 603F means: "over-current", or "" for those not known.
const char* errorCodeText(std::uint16_t code) noexcept;

/// Little endian number of `size` bytes (1 to 8).
void putLittleEndian(std::uint8_t* to, std::uint64_t value, std::size_t size) noexcept;
std::uint64_t getLittleEndian(const std::uint8_t* from, std::size_t size) noexcept;
/// The same, read as two's complement.
std::int64_t getSigned(const std::uint8_t* from, std::size_t size) noexcept;

}  // namespace ballbot
