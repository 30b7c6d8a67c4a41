#pragma once

#include <array>
#include <cstddef>

#include "hil/can_frame.hpp"

namespace ballbot {

/// Frames to send in one cycle, in order; of fixed size, so that filling it allocates nothing.
class FrameQueue {
 public:
  static constexpr std::size_t kCapacity = 96;

  /// False if it is full; the frame is lost then.
  bool push(const CanFrame& frame) noexcept {
    if (size_ == kCapacity) return false;
    CanFrame& slot = frames_[size_++];
    slot = frame;
    slot.flexible = slot.fast = flexible_;
    return true;
  }
  /// Frames for a CAN FD bus: all of them go as such, with the data at its own rate.
  void setFlexible(bool flexible) noexcept { flexible_ = flexible; }
  void clear() noexcept { size_ = 0; }
  std::size_t size() const noexcept { return size_; }
  const CanFrame* begin() const noexcept { return frames_.data(); }
  const CanFrame* end() const noexcept { return frames_.data() + size_; }

 private:
  std::array<CanFrame, kCapacity> frames_{};
  std::size_t size_ = 0;
  bool flexible_ = false;
};

}  // namespace ballbot
