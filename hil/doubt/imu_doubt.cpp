#include "hil/doubt/imu_doubt.hpp"

#include <cmath>

namespace ballbot {
namespace {

constexpr double kGravity = 9.81;
// A push may shake the base hard for a moment; lying in free fall or a blow of 3 g do not last.
constexpr double kLeastForce = 0.3 * kGravity, kMostForce = 3 * kGravity;
constexpr int kForceCycles = 8;
// Accelerating the robot leans the felt vertical, by 0.2 rad in the hardest pushes, for half a
// second. What leans for longer and further is an axis that is not where it is said to be.
constexpr double kLeanMemory = 0.25;  // [s]
constexpr double kMostLean = 0.5;     // [rad]

double norm(const std::array<double, 3>& v) noexcept {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

}  // namespace

ImuDoubt::ImuDoubt(const BenchConfig& config) : repeats_allowed_(config.safety.imu_repeats) {}

void ImuDoubt::rest() noexcept {
  has_last_ = false;
  accel_repeats_ = gyro_repeats_ = force_wrong_ = 0;
  off_ = {};
}

Finding ImuDoubt::check(double dt, const std::array<double, 3>& accel,
                        const std::array<double, 3>& gyro,
                        const std::array<double, 3>& up) noexcept {
  accel_repeats_ = has_last_ && accel == last_accel_ ? accel_repeats_ + 1 : 0;
  gyro_repeats_ = has_last_ && gyro == last_gyro_ ? gyro_repeats_ + 1 : 0;
  last_accel_ = accel;
  last_gyro_ = gyro;
  has_last_ = true;
  const int repeats = accel_repeats_ > gyro_repeats_ ? accel_repeats_ : gyro_repeats_;
  if (repeats_allowed_ > 0 && repeats >= repeats_allowed_) {
    return {BenchFault::kImuRepeats, -1, static_cast<double>(repeats),
            static_cast<double>(repeats_allowed_)};
  }
  const double force = norm(accel);
  force_wrong_ = force < kLeastForce || force > kMostForce ? force_wrong_ + 1 : 0;
  if (force_wrong_ >= kForceCycles) {
    return {BenchFault::kImuDisagrees, -1, force, force < kLeastForce ? kLeastForce : kMostForce};
  }
  if (force < kLeastForce) return {};
  const double share = dt < kLeanMemory ? dt / kLeanMemory : 1;
  for (std::size_t i = 0; i < 3; ++i) off_[i] += share * (accel[i] / force - up[i] - off_[i]);
  const double lean = norm(off_);
  if (lean <= kMostLean) return {};
  return {BenchFault::kImuDisagrees, -1, lean, kMostLean};
}

}  // namespace ballbot
