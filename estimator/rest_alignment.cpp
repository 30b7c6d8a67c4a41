#include "estimator/rest_alignment.hpp"

#include <cmath>

#include "model/frames.hpp"

namespace ballbot {

void RestAlignment::add(const Vector3& accel_B, const Vector3& gyro_B) noexcept {
  ++samples_;
  const double weight = 1.0 / static_cast<double>(samples_);
  mean_accel_ += weight * (accel_B - mean_accel_);
  mean_gyro_ += weight * (gyro_B - mean_gyro_);
}

Matrix3 RestAlignment::attitude() const noexcept {
  if (samples_ == 0) return Matrix3::Identity();
  // At rest accel = R' (0, 0, g) = g (-sin pitch, cos pitch sin roll, cos pitch cos roll).
  const double pitch = std::atan2(-mean_accel_.x(), std::hypot(mean_accel_.y(), mean_accel_.z()));
  const double roll = std::atan2(mean_accel_.y(), mean_accel_.z());
  return rotationFromYawPitchRoll(0.0, pitch, roll);
}

}  // namespace ballbot
