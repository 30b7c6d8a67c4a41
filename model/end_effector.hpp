#pragma once

#include "model/newton_euler.hpp"

namespace ballbot {

/// Kinematics of the end-effector E with derivatives, from a Newton-Euler pass already made.
/// Everything in axes of W; motions are pairs of displacement of E and rotation about W's axes.
template <typename Scalar>
class EndEffectorKinematics {
 public:
  using Pass = NewtonEuler<Scalar>;
  using Vec2 = Eigen::Matrix<Scalar, 2, 1>;
  using Vec3 = typename Pass::Vec3;
  using Mat3 = typename Pass::Mat3;
  using Vec6 = Eigen::Matrix<Scalar, 6, 1>;

  /// @param p_WK, v_WK  horizontal position and velocity of the ball's centre
  EndEffectorKinematics(const DynamicsConstants& constants, const Pass& pass, const Vec2& p_WK,
                        const Vec2& v_WK)
      : p_(pass) {
    const Motion<Scalar>& tip = p_.velocity.back();
    p_KE_W_ = p_.R_WB * p_.p_KE;
    v_KE_W_ = p_.R_WB * (tip.linear + cross(tip.angular, p_.p_KE));
    position = p_KE_W_ + Vec3(p_WK[0], p_WK[1], Scalar(constants.ball_radius));
    rotation = p_.R_WB * (p_.R_BA3 * constants.R_A3E.cast<Scalar>()).eval();
    velocity = v_KE_W_ + Vec3(v_WK[0], v_WK[1], Scalar(0));
    angular_velocity = p_.R_WB * tip.angular;
  }

  Vec3 position;  ///< p_WE
  Mat3 rotation;  ///< R_WE
  Vec3 velocity, angular_velocity;

  /// Motion per w_WB_B about axis k of B.
  Vec6 byOmega(int k) const { return turned(p_.R_WB.col(k)); }
  /// Motion per yaw, pitch or roll (k = 0, 1, 2), and the change of the twist.
  Vec6 byEuler(int k) const { return turned(eulerAxis(k)); }
  Vec6 twistByEuler(int k) const {
    const Vec3 axis = eulerAxis(k);
    return stacked(cross(axis, v_KE_W_), cross(axis, angular_velocity));
  }
  /// The same per angle of arm joint i.
  Vec6 byArm(int i) const {
    return stacked(p_.R_WB * p_.tipVelocity(i), p_.R_WB * p_.joint[i].angular);
  }
  Vec6 twistByArm(int i) const {
    // The joint turns what lies beyond it, and with it the velocities that joints beyond give E.
    Vec3 v_beyond = Vec3::Zero();
    for (int j = i + 1; j < kArmJointCount; ++j) v_beyond += p_.tipVelocity(j) * p_.rate[j];
    const Vec3 axis = p_.joint[i].angular, w_link = p_.velocity[i + 1].angular;
    const Vec3 w_beyond = p_.velocity.back().angular - w_link;
    const Vec3 dv = cross(w_link, p_.tipVelocity(i)) + cross(axis, v_beyond);
    return stacked(p_.R_WB * dv, p_.R_WB * cross(axis, w_beyond));
  }

 private:
  static Vec6 stacked(const Vec3& top, const Vec3& bottom) {
    Vec6 out;
    out.template head<3>() = top;
    out.template tail<3>() = bottom;
    return out;
  }
  Vec6 turned(const Vec3& axis) const { return stacked(cross(axis, p_KE_W_), axis); }
  Vec3 eulerAxis(int k) const {
    if (k == 0) return {Scalar(0), Scalar(0), Scalar(1)};
    if (k == 1) return {-p_.sin_yaw, p_.cos_yaw, Scalar(0)};
    return p_.R_WB.col(0);
  }

  const Pass& p_;
  Vec3 p_KE_W_, v_KE_W_;  ///< relative to K
};

}  // namespace ballbot
