#pragma once

#include <algorithm>

#include "model/state.hpp"

namespace ballbot {

/// The slowly varying part of the ball's velocity, at which the residuals are differentiated by
/// attitude: two first-order low passes of 30 ms, the second of which begins to follow where it is
/// 4 mm/s behind, four times the noise of the estimate at rest.
///
/// The estimated velocity itself will not do. It carries the noise of the gyroscope on the lever
/// arm of the IMU; its change over one interval is wrong by 0.4 m/s^2. In a derivative such noise
/// multiplies the noise of the very residual it came from, and the filter learns tilt and
/// accelerometer bias of a robot at rest, which nothing tells apart: measured, one degree wrong in
/// 15 s, with NIS as it should be. Low passes must have no direct feedthrough, hence two. And one
/// smooth velocity must serve all residuals, as end of one interval and as begin of the next,
/// because only then turning everything about the vertical costs nothing and yaw stays unknown.
class SmoothVelocity {
 public:
  /// Moves on by `h` [s], to be called before the update of that interval, whose estimate is not
  /// used; `velocity_W` is that of the interval's begin [m/s].
  void advance(const Eigen::Vector2d& velocity_W, double h) noexcept {
    const double gain = std::min(1.0, h / kTimeConstant);
    first_ += gain * (velocity_W - first_);
    const Eigen::Vector2d behind = first_ - value_;
    const double square = behind.squaredNorm();
    if (square > kDeadZone * kDeadZone)
      value_ += gain * (1 - kDeadZone * kDeadZone / square) * behind;
  }
  void jumpTo(const Eigen::Vector2d& velocity_W) noexcept { first_ = value_ = velocity_W; }
  /// The world turns out to lie otherwise about the vertical.
  void turn(const Eigen::Matrix2d& rotation) noexcept {
    first_ = rotation * first_;
    value_ = rotation * value_;
  }

  const Eigen::Vector2d& value() const { return value_; }  ///< [m/s]

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.first_);
    visit(self.value_);
  }

 private:
  static constexpr double kTimeConstant = 0.03;  // [s]
  static constexpr double kDeadZone = 0.004;     // [m/s]
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d value_ = Eigen::Vector2d::Zero();
};

}  // namespace ballbot
