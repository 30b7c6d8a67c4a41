#pragma once

#include <optional>

#include "core/time.hpp"

namespace ballbot {

/// How one quantity follows a step of its reference, from the step to the end of its window. It is
/// given as its deviation from the reference after the step; that of an angle is wrapped, and a
/// step of half a turn may be made either way round.
class StepResponse {
 public:
  /// The last stretch of the window, over which the remaining error is averaged.
  static constexpr SimDuration kSettled = std::chrono::milliseconds(500);
  enum class Kind { kLength, kAngle };

  /// @param size  height of the step, not zero; the step starts from where the quantity is then
  StepResponse(SimTime start, SimTime end, double size, Kind kind = Kind::kLength);

  /// @param deviation  value - reference; of an angle within half a turn [m or rad]
  void add(SimTime t, double deviation);

  /// Whether there was anything to see of it.
  bool measured() const { return from_.has_value(); }
  /// Time from the step until 90 % of the way to the reference are made first [s]; nothing if
  /// never.
  std::optional<double> riseTime() const { return rise_s_; }
  /// Furthest beyond the reference, in percent of the step; at least zero.
  double overshootPercent() const { return overshoot_percent_; }
  /// Furthest towards the reference, in percent of the step.
  double reachedPercent() const { return reached_percent_; }
  /// Mean of value - reference over the last half second; nothing before that.
  std::optional<double> remainingError() const;
  /// Furthest away from the reference before the rise, beyond where it was at the step, as a
  /// positive number in the quantity's unit.
  double againstFirst() const { return against_; }

 private:
  SimTime start_, end_;
  double size_;    ///< more than 0
  double period_;  ///< of the quantity: a turn, or infinite
  std::optional<double> from_, rise_s_;
  double came_from_ = 0;  ///< side of the reference, 1 or -1, on which it was at the rise
  double overshoot_percent_ = 0, reached_percent_ = 0, against_ = 0;
  double last_error_ = 0, error_sum_ = 0;
  long error_count_ = 0;
};

}  // namespace ballbot
