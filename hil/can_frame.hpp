#pragma once

#include <array>
#include <cstdint>

namespace ballbot {

/// One classic CAN frame, data or remote. CAN FD is not used: six drives fit without it.
struct CanFrame {
  static constexpr std::uint32_t kMaxStandardId = 0x7FF;
  static constexpr std::uint32_t kMaxExtendedId = 0x1FFFFFFF;
  static constexpr std::uint8_t kMaxSize = 8;

  std::uint32_t id = 0;  ///< 11 bits, or 29 if extended
  bool extended = false;
  bool remote = false;    ///< asks for a frame of `size` bytes and carries none
  std::uint8_t size = 0;  ///< 0 to 8
  std::array<std::uint8_t, kMaxSize> data{};
};

/// Whether the frame can be sent at all: identifier and size within their range.
constexpr bool isValid(const CanFrame& frame) noexcept {
  return frame.size <= CanFrame::kMaxSize &&
         frame.id <= (frame.extended ? CanFrame::kMaxExtendedId : CanFrame::kMaxStandardId);
}

/// Equal on the wire: bytes beyond `size`, and all of a remote frame, do not count.
constexpr bool operator==(const CanFrame& a, const CanFrame& b) noexcept {
  if (a.id != b.id || a.extended != b.extended || a.remote != b.remote || a.size != b.size) {
    return false;
  }
  for (std::uint8_t i = 0; !a.remote && i < a.size && i < CanFrame::kMaxSize; ++i) {
    if (a.data[i] != b.data[i]) return false;
  }
  return true;
}
constexpr bool operator!=(const CanFrame& a, const CanFrame& b) noexcept { return !(a == b); }

/// Bits of the frame between start and end of frame with the interframe space, without stuff bits
/// and with the most of them (one for every four bits after the first). What bus load is counted
/// in.
struct FrameBits {
  int nominal, worst;
};
constexpr FrameBits bitsOf(const CanFrame& frame) noexcept {
  const int payload = frame.remote ? 0 : 8 * frame.size;
  // Start bit to the end of the CRC is stuffed: 34 bits and data with an 11-bit identifier, 54
  // with 29; then 10 bits of delimiters, acknowledgement, end of frame, and 3 of space.
  const int stuffed = (frame.extended ? 54 : 34) + payload;
  return {stuffed + 13, stuffed + 13 + (stuffed - 1) / 4};
}

}  // namespace ballbot
