#pragma once

#include "model/omniwheel_kinematics.hpp"

namespace ballbot {

/// What three wheel rates and the base's angular velocity say about the ball.
struct BallMotion {
  Eigen::Vector2d velocity_W = Eigen::Vector2d::Zero();  ///< of the ball centre, in W [m/s]
  /// Angular velocity about the vertical [rad/s]. While the floor holds the ball it does not spin,
  /// and what stands here is the error of the angular velocity that was given.
  double spin = 0;
};

/// Rolling on the floor without slip; no slip between wheels and ball.
/// @param wheel_rates relative to the base [rad/s], @param w_WB_B of the base [rad/s]
BallMotion ballMotion(const OmniwheelKinematics& kinematics, double ball_radius,
                      const Matrix3& R_WB, const Vector3& wheel_rates,
                      const Vector3& w_WB_B) noexcept;

}  // namespace ballbot
