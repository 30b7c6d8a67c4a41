#include "estimator/wheel_odometry.hpp"

namespace ballbot {

BallMotion ballMotion(const OmniwheelKinematics& kinematics, double ball_radius,
                      const Matrix3& R_WB, const Vector3& wheel_rates,
                      const Vector3& w_WB_B) noexcept {
  const Vector3 kappa_W = R_WB * kinematics.ballAngularVelocity(wheel_rates, w_WB_B);
  // The contact point on the floor stands still: kappa = (-vy, vx, 0) / r.
  return {{ball_radius * kappa_W.y(), -ball_radius * kappa_W.x()}, kappa_W.z()};
}

}  // namespace ballbot
