#pragma once

#include <cstdint>

#include "model/state.hpp"

namespace ballbot {

/// Tilt and gyroscope bias of a robot that is held still: at rest the accelerometer shows minus
/// gravity and the gyroscope nothing but its bias, so their means over the rest give both. What no
/// rest can tell apart is tilt and horizontal accelerometer bias: the tilt is off by bias/g.
/// Free of allocation; may run in the control step.
class RestAlignment {
 public:
  /// One IMU sample taken at rest: specific force [m/s^2] and angular velocity [rad/s], in B.
  void add(const Vector3& accel_B, const Vector3& gyro_B) noexcept;

  std::int64_t samples() const { return samples_; }
  const Vector3& meanAccel() const { return mean_accel_; }
  /// Zero before the first sample.
  const Vector3& gyroBias() const { return mean_gyro_; }
  /// Attitude with yaw zero; identity before the first sample.
  Matrix3 attitude() const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.samples_);
    visit(self.mean_accel_);
    visit(self.mean_gyro_);
  }

 private:
  std::int64_t samples_ = 0;
  Vector3 mean_accel_ = Vector3::Zero();
  Vector3 mean_gyro_ = Vector3::Zero();
};

}  // namespace ballbot
