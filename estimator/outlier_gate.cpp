#include "estimator/outlier_gate.hpp"

#include <algorithm>
#include <cmath>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kMeanGain = 1.0 / 20;
constexpr int kStandingLong =
    8;  // intervals of 2.5 ms: at 0.02 rad/s an encoder of 0.025 deg moves

}  // namespace

void GateSettings::describe(ConfigVisitor& v) {
  v.number(may("wheel_gate_sigma", "standard deviations beyond which a wheel increment is refused"),
           wheel_gate_sigma, {2, 1e6});
  v.number(may("wheel_slip_sigma",
               "a wheel whose mean over 20 increments is further off is suspended until it halved"),
           wheel_slip_sigma, {0.5, 1e6});
  v.number(may("accel_jump_m_per_s2",
               "jump between samples beyond which the accelerometer's is a spike"),
           accel_jump_m_per_s2, {0.05, 1e6});
  v.number(
      may("gyro_jump_rad_per_s", "jump between samples beyond which the gyroscope's is a spike"),
      gyro_jump_rad_per_s, {0.005, 1e6});
  v.number(may("chi_square_limit", "above it the accelerometer is left out of an update"),
           chi_square_limit, {10, 1e12});
  v.number(may("state_doubt_after_s",
               "several wheels refused for so long: the state is at fault, not the wheels"),
           state_doubt_after_s, {0.005, 1e6});
}

bool SpikeGate::accepts(const Vector3& sample) noexcept {
  const bool ok = !started_ || (sample - accepted_).norm() < jump_ ||
                  (sample - last_).norm() < jump_ ||
                  (sample - last_ - (last_ - before_last_)).norm() < jump_;
  before_last_ = started_ ? last_ : sample;
  last_ = sample;
  if (ok) accepted_ = sample;
  started_ = true;
  return ok;
}

std::array<bool, kWheelCount> WheelGate::usable(
    const std::array<bool, kWheelCount>& measured) const noexcept {
  std::array<bool, kWheelCount> use = measured;
  for (std::size_t i = 0; i < kWheelCount; ++i) use[i] = use[i] && !wheels_[i].suspended;
  return use;
}

int WheelGate::worstOutlier(const Vector3& off,
                            const std::array<bool, kWheelCount>& use) const noexcept {
  int worst = -1;
  double size = settings_.wheel_gate_sigma;
  for (int i = 0; i < kWheelCount; ++i) {
    if (!use[static_cast<std::size_t>(i)]) continue;
    if (std::abs(off[i]) > size) {
      size = std::abs(off[i]);
      worst = i;
    }
  }
  return worst;
}

double WheelGate::largestMean(const std::array<bool, kWheelCount>& use) const noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (use[i]) largest = std::max(largest, std::abs(wheels_[i].mean));
  }
  return largest;
}

void WheelGate::settle(const Vector3& off, const IntervalMeasurement& m,
                       const std::array<bool, kWheelCount>& used,
                       RejectionCounts& counts) noexcept {
  int measured = 0, refused = 0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    measured += m.has_wheel[i] ? 1 : 0;
    refused += m.has_wheel[i] && !used[i] ? 1 : 0;
  }
  for (int i = 0; i < kWheelCount; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!m.has_wheel[at]) continue;
    Wheel& wheel = wheels_[at];
    wheel.standing = m.wheel_increment[i] == 0 ? wheel.standing + 1 : 0;
    const double limit = settings_.wheel_gate_sigma;
    wheel.mean += kMeanGain * (std::clamp(off[i], -limit, limit) - wheel.mean);
    if (wheel.standing == 0) wheel.stuck = false;
    if (!used[at]) {
      const bool stuck = refused == 1 && wheel.standing >= kStandingLong;
      wheel.stuck |= stuck;
      counts.add(stuck             ? Rejection::kWheel1Stuck
                 : wheel.suspended ? Rejection::kWheel1Slip
                                   : Rejection::kWheel1Outlier,
                 i);
    }
    const double threshold = settings_.wheel_slip_sigma * (wheel.suspended ? 0.5 : 1.0);
    // An encoder that is stuck agrees with a wheel that happens to stand.
    wheel.suspended = wheel.stuck || std::abs(wheel.mean) > threshold;
  }
  if (measured > 0) refused_s_ = refused >= 2 ? refused_s_ + m.h : 0.0;
}

bool WheelGate::anyStuck() const noexcept {
  return std::any_of(wheels_.begin(), wheels_.end(), [](const Wheel& w) { return w.stuck; });
}

bool WheelGate::doubtsState() const noexcept { return refused_s_ > settings_.state_doubt_after_s; }

void WheelGate::forget() noexcept {
  wheels_ = {};
  refused_s_ = 0;
}

}  // namespace ballbot
