#pragma once

#include <optional>

#include "core/time.hpp"

namespace ballbot {

/// How one quantity follows a step of its reference, from the step to the end of its window.
class StepResponse {
 public:
  /// The last stretch of the window, over which the remaining error is averaged.
  static constexpr SimDuration kSettled = std::chrono::milliseconds(500);

  /// @param size  height of the step, not zero; the step starts from where the quantity is then
  /// @param target  the reference after the step
  StepResponse(SimTime start, SimTime end, double size, double target);

  void add(SimTime t, double value);

  /// Time from the step until 90 % of it are reached first [s]; nothing if never.
  std::optional<double> riseTime() const { return rise_s_; }
  /// Furthest beyond the target, in percent of the step; at least zero.
  double overshootPercent() const { return overshoot_percent_; }
  /// Furthest towards the target, in percent of the step.
  double reachedPercent() const { return reached_percent_; }
  /// Mean of value - target over the last half second; nothing before that.
  std::optional<double> remainingError() const;
  /// Furthest against the direction of the step, as a positive number in the quantity's unit.
  double againstFirst() const { return against_; }

 private:
  SimTime start_, end_;
  double size_, target_;
  std::optional<double> from_, rise_s_;
  double overshoot_percent_ = 0, reached_percent_ = 0, against_ = 0;
  double error_sum_ = 0;
  long error_count_ = 0;
};

}  // namespace ballbot
