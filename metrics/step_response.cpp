#include "metrics/step_response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"

namespace ballbot {

StepResponse::StepResponse(SimTime start, SimTime end, double size, Kind kind)
    : start_(start),
      end_(end),
      size_(std::abs(size)),
      period_(kind == Kind::kAngle ? kTwoPi : std::numeric_limits<double>::infinity()) {}

void StepResponse::add(SimTime t, double deviation) {
  if (t < start_ || t >= end_) return;
  if (!from_) from_ = deviation;
  const double way = std::abs(*from_), left = std::abs(deviation);
  reached_percent_ = std::max(reached_percent_, 100 * (way - left) / size_);
  if (!rise_s_ && left <= 0.1 * way) {
    rise_s_ = toSeconds(t - start_);
    came_from_ = deviation < 0 ? -1 : 1;
  }
  if (rise_s_) {
    overshoot_percent_ = std::max(overshoot_percent_, -100 * came_from_ * deviation / size_);
  } else {
    // Only until the rise: later motion against the step is overshoot coming back.
    against_ = std::max(against_, left - way);
  }
  if (t >= end_ - kSettled) {
    // Continued, not wrapped: an error about half a turn must not average to none.
    last_error_ += std::remainder(deviation - last_error_, period_);
    error_sum_ += last_error_;
    ++error_count_;
  }
}

std::optional<double> StepResponse::remainingError() const {
  if (error_count_ == 0) return std::nullopt;
  return std::remainder(error_sum_ / static_cast<double>(error_count_), period_);
}

}  // namespace ballbot
