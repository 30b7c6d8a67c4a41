#pragma once

#include "model/robot_parameters.hpp"
#include "model/state.hpp"

namespace ballbot {

/// How ball, base and the three omni wheels move each other while nothing slips.
/// kappa_B: angular velocity of the ball in W, expressed in B; phi_dot: wheel rates relative to
/// the base. Source: rolling contact at r c_i, phi_dot_i = -(r/r_w) d_i . (kappa - w).
class OmniwheelKinematics {
 public:
  explicit OmniwheelKinematics(const RobotParameters& robot);

  /// Wheel rates [rad/s] from angular velocities of ball and base, both in B [rad/s].
  Vector3 wheelRates(const Vector3& kappa_B, const Vector3& w_WB_B) const;
  /// The reverse: ball angular velocity in B from wheel rates and base angular velocity.
  Vector3 ballAngularVelocity(const Vector3& wheel_rates, const Vector3& w_WB_B) const;

  /// Torque on the ball, in B, from wheel torques (the base gets the opposite) [N m].
  Vector3 ballTorque(const Vector3& wheel_torques) const;
  /// The reverse.
  Vector3 wheelTorques(const Vector3& ball_torque_B) const;

  /// Rolling on the floor: ball angular velocity in W from the velocity of its centre, no spin.
  static Vector3 rollingAngularVelocity(double vx, double vy, double radius);

  /// 3 x 8 rows of S(q): wheel rates = S_w nu.
  Eigen::Matrix<double, kWheelCount, kVelocityDim> wheelRows(const Matrix3& R_WB) const;

 private:
  double ball_radius_, ratio_;  ///< r [m], r / r_w
  Matrix3 axles_;               ///< rows d_i
  Matrix3 axles_inverse_;
};

}  // namespace ballbot
