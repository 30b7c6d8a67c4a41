#pragma once

#include <cstdint>

#include "hil/can_frame.hpp"

namespace ballbot {

/// Small repeatable generator for fuzz tests (xorshift64*).
class RandomBytes {
 public:
  explicit RandomBytes(std::uint64_t seed) : state_(seed * 2654435769U + 1) {}

  std::uint64_t next() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return state_ * 2685821657736338717ULL;
  }
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>((next() >> 32) * bound >> 32);
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(next() >> 56); }

  /// Any CAN FD frame that can be sent.
  CanFrame flexibleFrame() {
    CanFrame f = frame();
    f.remote = false;
    f.flexible = true;
    f.fast = below(2) == 1;
    f.size = kFlexibleSizes[below(16)];
    for (int i = 0; i < f.size; ++i) f.data[static_cast<std::size_t>(i)] = byte();
    return f;
  }
  /// Any classic frame that can be sent.
  CanFrame frame() {
    CanFrame f;
    f.extended = below(2) == 1;
    f.remote = below(4) == 0;
    f.id = below(f.extended ? CanFrame::kMaxExtendedId + 1 : CanFrame::kMaxStandardId + 1);
    f.size = static_cast<std::uint8_t>(below(9));
    for (int i = 0; !f.remote && i < f.size; ++i) f.data[static_cast<std::size_t>(i)] = byte();
    return f;
  }

 private:
  std::uint64_t state_;
};

}  // namespace ballbot
