#pragma once

#include "core/time.hpp"
#include "estimator/last_values.hpp"
#include "model/state.hpp"

namespace ballbot {

/// The last joint angles with their times, so that they can be had at the time of an IMU sample
/// that arrives later. Holds the last 64 different times: 22 ms of frames at 2.5 kHz and 400 Hz.
/// Free of allocation; may run in the control step.
class JointHistory {
 public:
  /// Times must not decrease; a second value of the same time replaces the first.
  void add(SimTime time, const JointVector& angle) noexcept;

  bool empty() const { return entries_.empty(); }
  SimTime newestTime() const noexcept { return entries_.fromNewest(0).time; }
  SimTime oldestTime() const noexcept { return entries_.fromNewest(entries_.size() - 1).time; }

  /// Angles at `time`, linear in between; held before the oldest and after the newest value.
  /// Not for an empty history [rad].
  JointVector at(SimTime time) const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.entries_);
  }

 private:
  struct Entry {
    SimTime time{};
    JointVector angle = JointVector::Zero();

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.time);
      visit(self.angle);
    }
  };

  LastValues<Entry, 64> entries_;
};

}  // namespace ballbot
