#pragma once

#include <array>

namespace ballbot {

/// How far the base leans, for the tilt limit only: gravity's direction in B, carried along by the
/// gyro and drawn slowly to what the accelerometer says. Independent of the controller's estimator.
class TiltMonitor {
 public:
  /// @param time_constant  of the accelerometer's pull [s]
  explicit TiltMonitor(double time_constant = 1.0) : time_constant_(time_constant) {}

  /// One IMU sample: specific force and angular velocity in B, `dt` after the one before [s].
  void update(double dt, const std::array<double, 3>& accel,
              const std::array<double, 3>& gyro) noexcept;
  /// Angle between the base's axis and the vertical [rad].
  double tilt() const noexcept;
  /// The vertical in B, unit length.
  const std::array<double, 3>& up() const noexcept { return up_; }

 private:
  double time_constant_;
  bool started_ = false;
  std::array<double, 3> up_{0, 0, 1};  ///< the vertical in B, unit length
};

}  // namespace ballbot
