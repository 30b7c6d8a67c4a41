#include "hil/commissioning/hand_watch.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

constexpr double kRest = 0.5;         // [s]
constexpr double kBaseAtRest = 0.05;  // [rad/s], above any gyroscope's bias and noise
constexpr double kNoMotion = 0.01;    // [rad] between two rests

template <typename Array>
void moveTowards(Array& mean, const Array& value, double share) noexcept {
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += share * (value[i] - mean[i]);
}

template <typename Array>
double largest(const Array& values) noexcept {
  double out = 0;
  for (const double v : values) out = std::max(out, std::abs(v));
  return out;
}

}  // namespace

HandWatch::HandWatch(double period, double rest_velocity) noexcept
    : period_(period),
      rest_velocity_(rest_velocity),
      rest_cycles_(std::max(1, static_cast<int>(std::lround(kRest / period)))) {}

void HandWatch::begin() noexcept {
  rested_ = 0;
  started_ = moved_ = false;
  turned_ = {};
  motion_ = {};
}

bool HandWatch::isStill(const BenchSample& s) const noexcept {
  return largest(s.joint_velocity) < rest_velocity_ && largest(s.gyro) < kBaseAtRest;
}

void HandWatch::average(const BenchSample& s) noexcept {
  const double share = 1.0 / rested_;
  moveTowards(mean_.joint_angle, s.joint_angle, share);
  moveTowards(mean_.motor_angle, s.motor_angle, share);
  moveTowards(mean_.accel, s.accel, share);
  moveTowards(mean_.gyro, s.gyro, share);
}

void HandWatch::conclude() noexcept {
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    motion_.joint[i] = mean_.joint_angle[i] - first_.joint_angle[i];
    motion_.motor[i] = mean_.motor_angle[i] - first_.motor_angle[i];
  }
  motion_.turned = turned_;
  motion_.before = first_.accel;
  motion_.after = mean_.accel;
  moved_ = moved_ || largest(motion_.joint) > kNoMotion || largest(motion_.turned) > kNoMotion;
}

void HandWatch::add(const BenchSample& s) noexcept {
  if (started_) {
    for (std::size_t k = 0; k < 3; ++k) turned_[k] += period_ * (s.gyro[k] - bias_[k]);
  }
  if (!isStill(s)) {
    rested_ = 0;
    return;
  }
  ++rested_;
  average(s);
  if (!atRest()) return;
  if (!started_) {
    started_ = true;
    first_ = mean_;
    bias_ = mean_.gyro;
    motion_.before = motion_.after = mean_.accel;
    return;
  }
  conclude();
}

}  // namespace ballbot
