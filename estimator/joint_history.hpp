#pragma once

#include <array>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// The last joint angles with their times, so that they can be had at the time of an IMU sample
/// that arrives later. Holds the last 64 different times: 22 ms of frames at 2.5 kHz and 400 Hz.
/// Free of allocation; may run in the control step.
class JointHistory {
 public:
  /// Times must not decrease; a second value of the same time replaces the first.
  void add(SimTime time, const JointVector& angle) noexcept;

  bool empty() const { return size_ == 0; }
  SimTime newestTime() const noexcept { return newest().time; }
  SimTime oldestTime() const noexcept { return fromNewest(size_ - 1).time; }

  /// Angles at `time`, linear in between; held before the oldest and after the newest value.
  /// Not for an empty history [rad].
  JointVector at(SimTime time) const noexcept;

  void save(BlobWriter& out) const;
  void restore(BlobReader& in);

 private:
  static constexpr int kCapacity = 64;
  struct Entry {
    SimTime time{};
    JointVector angle = JointVector::Zero();
  };
  const Entry& fromNewest(int age) const noexcept {
    return entries_[static_cast<std::size_t>((next_ + 2 * kCapacity - 1 - age) % kCapacity)];
  }
  const Entry& newest() const noexcept { return fromNewest(0); }

  std::array<Entry, kCapacity> entries_;
  int next_ = 0;
  int size_ = 0;
};

}  // namespace ballbot
