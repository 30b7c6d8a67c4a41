#pragma once

#include "hil/can_frame.hpp"

namespace ballbot {

/// Bits on the wire, by the rate that they go at; the interframe space counts, too.
struct WireBits {
  std::int64_t slow = 0;  ///< at the bit rate of the bus: all of a classic frame
  std::int64_t fast = 0;  ///< at the data bit rate of CAN FD

  constexpr WireBits& operator+=(const WireBits& other) noexcept {
    slow += other.slow;
    fast += other.fast;
    return *this;
  }
  /// Time that they take [us]. @param data_bitrate_kbps  not used without fast bits
  constexpr double microseconds(double bitrate_kbps, double data_bitrate_kbps) const noexcept {
    const double us = 1000.0 * static_cast<double>(slow) / bitrate_kbps;
    return fast == 0 ? us : us + 1000.0 * static_cast<double>(fast) / data_bitrate_kbps;
  }
};

/// Of a frame without stuff bits that depend on its content, and with as many of them as there can
/// be: one for every four bits after the first. What bus load is counted in.
struct FrameBits {
  WireBits nominal, worst;
};

/// ISO 11898-1. Bits at which the rate changes (BRS, CRC delimiter) count as slow ones. A CAN FD
/// frame without BRS is slow throughout.
constexpr FrameBits bitsOf(const CanFrame& frame) noexcept {
  constexpr int kDelimiters = 10, kSpace = 3;  // CRC delimiter, acknowledgement, end of frame
  const int payload = frame.remote ? 0 : 8 * frame.size;
  if (!frame.flexible) {
    // Start bit to the end of the CRC is stuffed: 34 bits and data with an 11-bit identifier, 54
    // with 29.
    const int stuffed = (frame.extended ? 54 : 34) + payload;
    const int rest = kDelimiters + kSpace;
    return {{stuffed + rest, 0}, {stuffed + rest + (stuffed - 1) / 4, 0}};
  }
  // Start bit to BRS; then ESI, length and data; then stuff count and CRC, with a stuff bit before
  // every four bits of them.
  const int head = frame.extended ? 36 : 17, middle = 5 + payload;
  const int check = frame.size <= 16 ? 4 + 17 + 6 : 4 + 21 + 7;
  const int tail = kDelimiters + kSpace;
  const int most_in_head = (head - 1) / 4, most = (head + middle - 1) / 4;
  FrameBits bits{{head + tail, middle + check},
                 {head + tail + most_in_head, middle + check + most - most_in_head}};
  if (!frame.fast) {
    for (WireBits* b : {&bits.nominal, &bits.worst}) *b = {b->slow + b->fast, 0};
  }
  return bits;
}

}  // namespace ballbot
