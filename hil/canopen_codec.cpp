#include "hil/canopen_codec.hpp"

#include <algorithm>

namespace ballbot {
namespace {

bool isPlainData(const CanFrame& frame, std::uint8_t size) noexcept {
  return !frame.extended && !frame.remote && frame.size == size;
}

/// Node of a frame whose identifier is `base` + node, or 0.
int nodeOf(const CanFrame& frame, std::uint32_t base) noexcept {
  if (frame.id < base + kNodeIdMin || frame.id > base + kNodeIdMax) return 0;
  return static_cast<int>(frame.id - base);
}

struct CodeName {
  std::uint16_t code, mask;
  const char* name;
};
// From the most to the least specific.
constexpr CodeName kCodeNames[] = {
    {0x0000, 0xFFFF, "error reset"},
    {0x2310, 0xFFFF, "over-current at the output"},
    {0x3210, 0xFFFF, "over-voltage of the supply"},
    {0x3220, 0xFFFF, "under-voltage of the supply"},
    {0x4310, 0xFFFF, "drive too hot"},
    {0x7305, 0xFFFF, "encoder 1"},
    {0x8110, 0xFFFF, "CAN overrun"},
    {0x8120, 0xFFFF, "CAN error passive"},
    {0x8130, 0xFFFF, "heartbeat of another node lost"},
    {0x8140, 0xFFFF, "recovered from bus-off"},
    {0x8210, 0xFFFF, "PDO too short"},
    {0x8220, 0xFFFF, "PDO too long"},
    {0x8240, 0xFFFF, "SYNC of wrong length"},
    {0x8250, 0xFFFF, "RPDO timeout"},
    {0x2000, 0xF000, "current"},
    {0x3000, 0xF000, "voltage"},
    {0x4000, 0xF000, "temperature"},
    {0x5000, 0xF000, "device hardware"},
    {0x6000, 0xF000, "device software"},
    {0x7000, 0xF000, "additional modules"},
    {0x8000, 0xF000, "monitoring"},
    {0xF000, 0xF000, "additional functions"},
};

}  // namespace

const char* toText(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "boot-up";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
  }
  return "unknown";
}

CanFrame nmtFrame(NmtCommand command, int node) noexcept {
  CanFrame frame;
  frame.id = kCobNmt;
  frame.size = 2;
  frame.data[0] = static_cast<std::uint8_t>(command);
  frame.data[1] = static_cast<std::uint8_t>(node);
  return frame;
}

CanFrame syncFrame() noexcept {
  CanFrame frame;
  frame.id = kCobSync;
  return frame;
}

CanFrame heartbeatFrame(int node, NmtState state) noexcept {
  CanFrame frame;
  frame.id = kCobHeartbeat + static_cast<std::uint32_t>(node);
  frame.size = 1;
  frame.data[0] = static_cast<std::uint8_t>(state);
  return frame;
}

std::optional<Heartbeat> readHeartbeat(const CanFrame& frame) noexcept {
  const int node = nodeOf(frame, kCobHeartbeat);
  if (node == 0 || !isPlainData(frame, 1)) return std::nullopt;
  switch (static_cast<NmtState>(frame.data[0])) {
    case NmtState::kBootUp:
    case NmtState::kStopped:
    case NmtState::kOperational:
    case NmtState::kPreOperational:
      return Heartbeat{node, static_cast<NmtState>(frame.data[0])};
  }
  return std::nullopt;
}

std::optional<Emergency> readEmergency(const CanFrame& frame) noexcept {
  const int node = nodeOf(frame, kCobEmergency);
  if (node == 0 || !isPlainData(frame, 8)) return std::nullopt;
  Emergency e{
      node, static_cast<std::uint16_t>(getLittleEndian(frame.data.data(), 2)), frame.data[2], {}};
  std::copy(frame.data.begin() + 3, frame.data.begin() + 8, e.vendor.begin());
  return e;
}

const char* errorCodeText(std::uint16_t code) noexcept {
  for (const CodeName& entry : kCodeNames) {
    if ((code & entry.mask) == entry.code) return entry.name;
  }
  return "";
}

void putLittleEndian(std::uint8_t* to, std::uint64_t value, std::size_t size) noexcept {
  for (std::size_t i = 0; i < size; ++i) to[i] = static_cast<std::uint8_t>(value >> 8 * i);
}

std::uint64_t getLittleEndian(const std::uint8_t* from, std::size_t size) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(from[i]) << 8 * i;
  return value;
}

std::int64_t getSigned(const std::uint8_t* from, std::size_t size) noexcept {
  const std::uint64_t value = getLittleEndian(from, size);
  if (size >= 8 || (value >> (8 * size - 1) & 1U) == 0) return static_cast<std::int64_t>(value);
  return static_cast<std::int64_t>(value | ~std::uint64_t{0} << 8 * size);
}

}  // namespace ballbot
