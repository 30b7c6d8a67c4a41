#pragma once

#include <cstdint>

namespace ballbot {

/// Counts cycles without data among the last ones: what comes every third cycle is never missing
/// for long, and still much is missing. Pure; nothing allocates.
class MissWindow {
 public:
  static constexpr int kCycles = 32;

  void add(bool missed) noexcept {
    if ((bits_ & kOldest) != 0) --count_;
    bits_ = bits_ << 1 | (missed ? 1U : 0U);
    if (missed) ++count_;
  }
  /// Among the last kCycles.
  int count() const noexcept { return count_; }
  void clear() noexcept {
    bits_ = 0;
    count_ = 0;
  }

 private:
  static constexpr std::uint32_t kOldest = 1U << 31;
  std::uint32_t bits_ = 0;
  int count_ = 0;
};

}  // namespace ballbot
