#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace ballbot {

/// Hands values from one writing thread to one reading thread without locks: the reader always gets
/// the newest value that is complete, the writer is never held up. Three slots: one being written,
/// one being read, one in between. Values are not copied and nothing is allocated.
template <typename T>
class LatestValue {
 public:
  explicit LatestValue(const T& initial) : slots_{initial, initial, initial} {}

  /// Writer: the slot to fill.
  T& back() noexcept { return slots_[back_]; }
  /// Writer: makes back() the newest value; back() then is another slot with an old value.
  void publish() noexcept {
    back_ = between_.exchange(static_cast<std::uint8_t>(back_ | kNew), std::memory_order_acq_rel) &
            kSlot;
  }

  /// Reader: moves on to the newest value; false if there is none newer than front().
  bool update() noexcept {
    if (!(between_.load(std::memory_order_relaxed) & kNew)) return false;
    front_ = between_.exchange(front_, std::memory_order_acq_rel) & kSlot;
    return true;
  }
  /// Reader: the value it holds.
  const T& front() const noexcept { return slots_[front_]; }

 private:
  static constexpr std::uint8_t kSlot = 3, kNew = 4;

  std::array<T, 3> slots_;
  std::uint8_t back_ = 0;                 // writer's alone
  std::atomic<std::uint8_t> between_{1};  // slot, and whether the reader has not seen it
  std::uint8_t front_ = 2;                // reader's alone
};

}  // namespace ballbot
