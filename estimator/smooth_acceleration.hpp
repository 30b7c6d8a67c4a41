#pragma once

#include <algorithm>

#include "core/state_blob.hpp"
#include "model/state.hpp"

namespace ballbot {

/// The slowly varying part of the ball's acceleration: two first-order low passes of 30 ms, and
/// nothing below 0.03 m/s^2, three times the noise that is left. Two, because the first one's
/// newest samples still carry noise that the next update meets again (model/residuals use it).
class SmoothAcceleration {
 public:
  void add(const Eigen::Vector2d& accel_W, double h) noexcept {
    const double gain = std::min(1.0, h / kTimeConstant);
    first_ += gain * (accel_W - first_);
    second_ += gain * (first_ - second_);
  }

  /// [m/s^2]
  Eigen::Vector2d value() const noexcept {
    const double square = second_.squaredNorm();
    if (square <= kDeadZone * kDeadZone) return Eigen::Vector2d::Zero();
    return (1 - kDeadZone * kDeadZone / square) * second_;
  }

  void save(BlobWriter& out) const {
    out.putDoubles(first_.data(), 2);
    out.putDoubles(second_.data(), 2);
  }
  void restore(BlobReader& in) {
    in.getDoubles(first_.data(), 2);
    in.getDoubles(second_.data(), 2);
  }

 private:
  static constexpr double kTimeConstant = 0.03;  // [s]
  static constexpr double kDeadZone = 0.03;      // [m/s^2]
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d second_ = Eigen::Vector2d::Zero();
};

}  // namespace ballbot
