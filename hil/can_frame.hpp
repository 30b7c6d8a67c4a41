#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace ballbot {

/// One CAN frame: classic, data or remote, or CAN FD.
struct CanFrame {
  static constexpr std::uint32_t kMaxStandardId = 0x7FF;
  static constexpr std::uint32_t kMaxExtendedId = 0x1FFFFFFF;
  static constexpr std::uint8_t kMaxSize = 8, kMaxFlexibleSize = 64;

  std::uint32_t id = 0;  ///< 11 bits, or 29 if extended
  bool extended = false;
  bool remote = false;    ///< asks for a frame of `size` bytes and carries none
  std::uint8_t size = 0;  ///< 0 to 8; CAN FD: one of kFlexibleSizes
  std::array<std::uint8_t, kMaxFlexibleSize> data{};
  bool flexible = false;  ///< CAN FD (FDF)
  bool fast = false;      ///< its data at the bus's data bit rate (BRS)
};

/// Bytes that a CAN FD frame can have, by its data length code.
constexpr std::array<std::uint8_t, 16> kFlexibleSizes{0, 1,  2,  3,  4,  5,  6,  7,
                                                      8, 12, 16, 20, 24, 32, 48, 64};

/// The data length code of the shortest CAN FD frame that holds so many bytes; 16 if none does.
constexpr std::uint8_t flexibleLengthCode(std::size_t bytes) noexcept {
  std::uint8_t code = 0;
  while (code < kFlexibleSizes.size() && kFlexibleSizes[code] < bytes) ++code;
  return code;
}

/// Whether the frame can be sent at all: identifier and size within their range.
constexpr bool isValid(const CanFrame& frame) noexcept {
  const bool sized = frame.flexible
                         ? !frame.remote && frame.size <= CanFrame::kMaxFlexibleSize &&
                               kFlexibleSizes[flexibleLengthCode(frame.size)] == frame.size
                         : frame.size <= CanFrame::kMaxSize && !frame.fast;
  return sized &&
         frame.id <= (frame.extended ? CanFrame::kMaxExtendedId : CanFrame::kMaxStandardId);
}

/// Equal on the wire: bytes beyond `size`, and all of a remote frame, do not count.
constexpr bool operator==(const CanFrame& a, const CanFrame& b) noexcept {
  if (a.id != b.id || a.extended != b.extended || a.remote != b.remote || a.size != b.size ||
      a.flexible != b.flexible || a.fast != b.fast) {
    return false;
  }
  const std::size_t most = std::min<std::size_t>(a.size, a.data.size());
  for (std::size_t i = 0; !a.remote && i < most; ++i) {
    if (a.data[i] != b.data[i]) return false;
  }
  return true;
}
constexpr bool operator!=(const CanFrame& a, const CanFrame& b) noexcept { return !(a == b); }

}  // namespace ballbot
