#include "metrics/step_response.hpp"

#include <algorithm>

namespace ballbot {

StepResponse::StepResponse(SimTime start, SimTime end, double size, double target)
    : start_(start), end_(end), size_(size), target_(target) {}

void StepResponse::add(SimTime t, double value) {
  if (t < start_ || t >= end_) return;
  if (!from_) from_ = value;
  const double reached = (value - *from_) / (target_ - *from_);
  reached_percent_ = std::max(reached_percent_, 100 * (value - *from_) / size_);
  if (!rise_s_ && reached >= 0.9) rise_s_ = toSeconds(t - start_);
  overshoot_percent_ = std::max(overshoot_percent_, 100 * (value - target_) / size_);
  // Only until the rise: later motion against the step is overshoot coming back.
  if (!rise_s_) against_ = std::max(against_, size_ > 0 ? *from_ - value : value - *from_);
  if (t >= end_ - kSettled) {
    error_sum_ += value - target_;
    ++error_count_;
  }
}

std::optional<double> StepResponse::remainingError() const {
  if (error_count_ == 0) return std::nullopt;
  return error_sum_ / static_cast<double>(error_count_);
}

}  // namespace ballbot
