#pragma once

#include <array>

#include "plant/multibody.hpp"

namespace ballbot {

// Order of the velocities that both structures share, at the start of Simbody's u:
//   (vx, vy | w_WB_W | arm rates | ball spin, if the ball can spin)
constexpr int kOmegaU = 2, kArmU = 5, kSpinU = 8;
constexpr int kSharedDim = 9;
using SharedRow = std::array<double, kSharedDim>;

/// How the wheels turn when base and ball move and nothing slips:
///
///   dphi_i = -(r/r_w) d_i . (kappa - w),  kappa = (-vy/r, vx/r, spin)
///
/// with w the base's and kappa the ball's angular velocity, d_i the axle of wheel i, all in W.
class WheelRolling {
 public:
  explicit WheelRolling(const RobotParameters& robot);

  /// Rates of the wheels relative to the base [rad/s]. Of accelerations: their share in ddphi.
  Vector3 rates(const Matrix3& R_WB, const Vector3& v_WK_W, const Vector3& w_WB_W,
                double ball_spin) const;
  /// The rest of ddphi, from the axles turning [rad/s^2].
  Vector3 bias(const BaseMotion& base) const;
  /// dphi_i as a row that multiplies the shared velocities.
  SharedRow row(const Matrix3& R_WB, int wheel) const;

 private:
  Vector3 ballRate(const Vector3& v_WK_W, double ball_spin) const;

  double ball_radius_, ratio_;  ///< r [m], r / r_w
  Matrix3 axles_B_;             ///< columns d_i in B
};

/// Where an actuator's housing sits: wheels on the base, arm joints on the link before.
struct ActuatorMount {
  BodyIndex parent;
  Vector3 axis;    ///< unit, in parent's axes
  Vector3 p_PA_P;  ///< in the parent's frame [m]
};
std::array<ActuatorMount, kJointCount> actuatorMounts(const RobotParameters& robot);

}  // namespace ballbot
