#include "estimator/spin_gate.hpp"

#include <algorithm>
#include <cmath>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kMeanGain = 1.0 / 20;
constexpr double kAnySpin = 20;       // [rad/s]
constexpr double kLargestOff = 5;     // an increment tells no more than that [standard deviations]
constexpr double kBeyondCreep = 3;    // [standard deviations]
constexpr double kLeastOnset = 0.03;  // [rad/s]
/// The mean of a spin that turns round passes zero; the spin itself is far from it then.
constexpr double kMomentary = 5;

}  // namespace

void SpinSettings::describe(ConfigVisitor& v) {
  v.boolean(may("enabled", "whether the ball's spin about the vertical is estimated, or is zero"),
            enabled);
  v.number(may("creep_rad_per_s",
               "spin of a ball that the floor holds and no wheel turns, one standard deviation"),
           creep, {1e-5, 1});
  v.number(may("creep_rad_per_s_per_Nm", "what the wheels' torque about the vertical adds to it"),
           creep_per_torque, {0, 10});
  v.number(may("creep_time_s", "how long it creeps alike"), creep_time_s, {1e-3, 100});
  v.number(may("acceleration_rad_per_s2", "of a ball that spins, by wheels and floor"),
           acceleration, {0.1, 1e4});
  v.number(may("jump_sigma",
               "common part of the wheels' residuals, of one increment, at which the ball spins"),
           jump_sigma, {2, 1e6});
  v.number(may("onset_sigma",
               "common part of the wheels' residuals, mean over 20 increments, at which it spins"),
           onset_sigma, {0.2, 1e6});
  v.number(may("sticks_below_rad_per_s", "mean spin over 20 increments, below which it is held"),
           sticks_below, {1e-4, 1});
}

void SpinGate::expect(double spin, IntervalMeasurement& m) noexcept {
  creep_ = settings_.creep + settings_.creep_per_torque * std::abs(m.spin_load);
  if (spinning_) {
    m.spin_kept = 1;
    m.spin_sigma = settings_.acceleration * m.h;
  } else {
    m.spin_kept = std::exp(-m.h / settings_.creep_time_s);
    m.spin_sigma = creep_ * std::sqrt(1 - m.spin_kept * m.spin_kept);
  }
  m.smooth_spin = m.spin_kept * spin;
}

bool SpinGate::jumps(double common, const Vector3& off,
                     const std::array<bool, kWheelCount>& use) const noexcept {
  double alone = settings_.jump_sigma;
  for (int i = 0; i < kWheelCount; ++i) {
    if (use[static_cast<std::size_t>(i)]) alone = std::max(alone, std::abs(off[i]));
  }
  return std::abs(common) > alone;
}

void SpinGate::expectAnything(IntervalMeasurement& m) noexcept { m.spin_sigma = kAnySpin; }

void SpinGate::settle(const std::array<bool, kWheelCount>& used, bool jumped, double common,
                      double largest_wheel_mean) noexcept {
  jumped_ = jumped;
  // A wheel that turned out to slip has had its part in the mean.
  if (used != used_) common_mean_ = 0;
  used_ = used;
  if (!spinning_) {
    common_mean_ += kMeanGain * (std::clamp(common, -kLargestOff, kLargestOff) - common_mean_);
  }
  // A wheel that slips has a common part too, but is itself further off.
  common_leads_ = std::abs(common_mean_) > largest_wheel_mean;
}

void SpinGate::follow(double spin) noexcept {
  const bool begins =
      jumped_ || (common_leads_ && (std::abs(common_mean_) > settings_.onset_sigma ||
                                    std::abs(spin) > std::max(kLeastOnset, kBeyondCreep * creep_)));
  if (spinning_) {
    spin_mean_ += kMeanGain * (spin - spin_mean_);
    spinning_ = std::abs(spin_mean_) > settings_.sticks_below ||
                std::abs(spin) > kMomentary * settings_.sticks_below;
  } else if (begins) {
    spinning_ = true;
    spin_mean_ = spin;
    common_mean_ = 0;
  }
}

void SpinGate::forget() noexcept {
  spinning_ = jumped_ = common_leads_ = false;
  common_mean_ = spin_mean_ = creep_ = 0;
}

}  // namespace ballbot
