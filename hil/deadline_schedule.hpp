#pragma once

#include <cstdint>

namespace ballbot {

/// Absolute deadlines of a periodic loop: cycle k is due at start + k period, whatever happened
/// before. A loop that is late skips the periods it has missed; it never runs two in a row to catch
/// up. Pure: the caller knows the time.
class DeadlineSchedule {
 public:
  DeadlineSchedule(std::int64_t start_ns, std::int64_t period_ns)
      : start_ns_(start_ns), period_ns_(period_ns) {}

  std::int64_t cycle() const noexcept { return cycle_; }
  std::int64_t deadline() const noexcept { return start_ns_ + cycle_ * period_ns_; }

  /// The work of this cycle ended at `now_ns`: moves to the next cycle that can still begin in
  /// time.
  /// @return periods skipped
  std::int64_t advance(std::int64_t now_ns) noexcept {
    const std::int64_t next = cycle_ + 1;
    const std::int64_t behind = now_ns - (start_ns_ + next * period_ns_);
    // A deadline that has just passed is still met late; whole periods that have passed are not.
    const std::int64_t skipped = behind > 0 ? behind / period_ns_ : 0;
    cycle_ = next + skipped;
    skipped_ += skipped;
    if (behind > 0) ++overruns_;
    return skipped;
  }
  std::int64_t skipped() const noexcept { return skipped_; }
  /// Cycles whose work went beyond their period.
  std::int64_t overruns() const noexcept { return overruns_; }

 private:
  std::int64_t start_ns_, period_ns_;
  std::int64_t cycle_ = 0, skipped_ = 0, overruns_ = 0;
};

}  // namespace ballbot
