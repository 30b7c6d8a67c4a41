#pragma once

#include <array>
#include <cmath>

#include "model/dynamics_constants.hpp"
#include "model/sine_cosine.hpp"
#include "model/spatial.hpp"
#include "model/spinning_state.hpp"

namespace ballbot {

/// Of kCount angles; the arrays have room for whole eights.
template <int kCount, typename Scalar>
void sinesAndCosines(const Scalar* angle, Scalar* sine, Scalar* cosine) {
  for (int i = 0; i < kCount; ++i) {
    sine[i] = std::sin(angle[i]);
    cosine[i] = std::cos(angle[i]);
  }
}
template <int kCount>
void sinesAndCosines(const double* angle, double* sine, double* cosine) {
  for (int i = 0; i < kCount; i += 8) sineCosine8(angle + i, sine + i, cosine + i);
}

/// Newton-Euler pass of the reduced model at one state. Everything is expressed in axes of B with
/// the origin at K; velocities are relative to an inertial frame that moves along with K just now,
/// so that of the base's motion only the rotation remains. Scalar is double, or a type that carries
/// derivatives.
///
/// The wheels' mass and transverse inertia belong to the base. Their spin enters by the momentum
/// G s with s = (1 + rho) w - rho kappa, for which d_i . s = d_i . w + phi_dot_i is the spin of
/// wheel i in W.
///
/// kSpin: the ball may spin about the vertical, with a ninth velocity (spinning_state.hpp) and an
/// equation of motion of its own. It adds to kappa = R^T (J_K v + z spin), and so to the wheels'
/// momentum; of its own it has the ball's inertia, the same about every axis, and nothing else.
template <typename Scalar, bool kSpin = false>
class NewtonEuler {
 public:
  static constexpr int kVelocities = kSpin ? kSpinningVelocityDim : kVelocityDim;
  using Vec3 = Eigen::Matrix<Scalar, 3, 1>;
  using Mat3 = Eigen::Matrix<Scalar, 3, 3>;
  using Vec6 = Eigen::Matrix<Scalar, kJointCount, 1>;
  using Vec8 = Eigen::Matrix<Scalar, kVelocityDim, 1>;
  using Velocities = Eigen::Matrix<Scalar, kVelocities, 1>;  ///< Vec8 without spin
  using Mass = Eigen::Matrix<Scalar, kVelocities, kVelocities>;
  template <typename T>
  using PerJoint = std::array<T, kArmJointCount>;
  template <typename T>
  using PerBody = std::array<T, 1 + kArmJointCount>;

  NewtonEuler(const DynamicsConstants& constants, const Vec8& q, const Velocities& nu)
      : c_(constants), rho_(constants.ratio), G_(constants.spin_inertia.cast<Scalar>()) {
    placeBase(q, nu);
    goOutward(q, nu);
    goInward();
  }

  /// h(q, nu): the generalised force that dnu/dt = 0 takes.
  [[gnu::flatten]] Velocities nonlinearEffects() const {
    Velocities h;
    const Vec3 spin_torque = rho_ * (G_ * cross(omega, kappa));
    h.template head<2>() =
        (R_WB * bias[0].force).template head<2>() - rho_ * (rolling.transpose() * spin_torque);
    h.template segment<3>(kOmegaX) =
        bias[0].moment + (Scalar(1) + rho_) * spin_torque + cross(omega, spin_momentum);
    for (int i = 0; i < kArmJointCount; ++i) h[kArmRate1 + i] = dot(joint[i], bias[i + 1]);
    if constexpr (kSpin) h[kBallSpin] = -rho_ * dot(R_WB.row(2), spin_torque);
    return h;
  }

  /// M(q), by composite rigid bodies.
  [[gnu::flatten]] Mass massMatrix() const {
    Mass M;
    const Scalar one(1);
    const Eigen::Matrix<Scalar, 3, 2> G_rolling = G_ * rolling;
    M.template topLeftCorner<2, 2>() = rho_ * rho_ * (rolling.transpose() * G_rolling);
    const Scalar translating(c_.rolling_mass + composite[0].mass);
    M(0, 0) += translating;
    M(1, 1) += translating;
    for (int k = 0; k < 3; ++k) {
      M.template block<2, 1>(kBallVx, kOmegaX + k) =
          -rho_ * (one + rho_) * G_rolling.row(k).transpose();
    }
    // A row of R times -skew(first) is first x row.
    for (int k = 0; k < 2; ++k) {
      M.template block<1, 3>(kBallVx + k, kOmegaX) +=
          cross(composite[0].first, R_WB.row(k)).transpose();
    }
    const Mat3& second = composite[0].second;
    M.template block<3, 3>(kOmegaX, kOmegaX) = (one + rho_) * (one + rho_) * G_ - second;
    for (int k = 0; k < 3; ++k) M(kOmegaX + k, kOmegaX + k) += second.trace();
    for (int i = 0; i < kArmJointCount; ++i) {
      const int column = kArmRate1 + i;
      for (int k = 0; k < 2; ++k) M(k, column) = dot(R_WB.row(k), joint_wrench[i].force);
      M.template block<3, 1>(kOmegaX, column) = joint_wrench[i].moment;
      for (int j = 0; j <= i; ++j) M(kArmRate1 + j, column) = dot(joint[j], joint_wrench[i]);
    }
    if constexpr (kSpin) {
      const Vec3 G_up = G_ * R_WB.row(2).transpose();
      for (int k = 0; k < 2; ++k) M(k, kBallSpin) = rho_ * rho_ * dot(rolling.col(k), G_up);
      M.template block<3, 1>(kOmegaX, kBallSpin) = -rho_ * (one + rho_) * G_up;
      for (int i = 0; i < kArmJointCount; ++i) M(kArmRate1 + i, kBallSpin) = Scalar(0);
      M(kBallSpin, kBallSpin) = Scalar(c_.ball_inertia) + rho_ * rho_ * dot(R_WB.row(2), G_up);
    }
    for (int i = 0; i < kVelocities; ++i) {
      for (int j = 0; j < i; ++j) M(i, j) = M(j, i);
    }
    return M;
  }

  /// S(q)^T tau + J_E(q)^T lambda_W; what the floor does against a spin comes on top.
  [[gnu::flatten]] Velocities appliedForce(const Vec6& tau, const Vec3& lambda_W) const {
    const Vec3 ball_torque = ballTorque(tau);
    const Vec3 lambda = R_WB.transpose() * lambda_W;
    Velocities force;
    force.template head<2>() = rolling.transpose() * ball_torque + lambda_W.template head<2>();
    force.template segment<3>(kOmegaX) = cross(p_KE, lambda) - ball_torque;
    for (int i = 0; i < kArmJointCount; ++i) {
      force[kArmRate1 + i] = tau[kWheelCount + i] + dot(tipVelocity(i), lambda);
    }
    if constexpr (kSpin) force[kBallSpin] = dot(R_WB.row(2), ball_torque);
    return force;
  }

  /// Adds what a moment on the end-effector does.
  void addMoment(const Vec3& moment_W, Velocities& force) const {
    const Vec3 moment = R_WB.transpose() * moment_W;
    force.template segment<3>(kOmegaX) += moment;
    for (int i = 0; i < kArmJointCount; ++i) force[kArmRate1 + i] += dot(joint[i].angular, moment);
  }

  /// Rates of yaw, pitch and roll.
  Vec3 eulerRates() const {
    const Scalar yaw = (sin_roll * omega[1] + cos_roll * omega[2]) / cos_pitch;
    return {yaw, cos_roll * omega[1] - sin_roll * omega[2], omega[0] + sin_pitch * yaw};
  }

  /// Torque of the wheels on the ball, in B.
  Vec3 ballTorque(const Vec6& tau) const {
    return -rho_ * (c_.axles.transpose().template cast<Scalar>() * tau.template head<3>());
  }

  /// Velocity of E in B per rate of arm joint i.
  Vec3 tipVelocity(int i) const { return joint[i].linear + cross(joint[i].angular, p_KE); }

  // Index 0 stands for the base, i for arm link i; joint i - 1 leads to link i.
  Scalar sin_yaw, cos_yaw, sin_pitch, cos_pitch, sin_roll, cos_roll;
  PerJoint<Scalar> sin_arm, cos_arm;
  Mat3 R_WB;
  Mat3 R_BA3;  ///< last link's axes
  Vec3 p_KE;
  Eigen::Matrix<Scalar, 3, 2> rolling;    ///< R^T J_K: kappa = rolling (vx, vy), spin apart
  PerJoint<Motion<Scalar>> joint;         ///< motion per unit of joint rate
  PerJoint<Motion<Scalar>> joint_rate;    ///< its rate of change, from the parent's motion
  PerJoint<Wrench<Scalar>> joint_wrench;  ///< composite momentum per unit of joint rate

  Vec3 omega, kappa, spin_momentum;  ///< of base, ball, and of the wheels: G s
  PerBody<Motion<Scalar>> velocity;
  PerBody<MassMoments<Scalar>> composite;   ///< of the body and all beyond it
  PerBody<VelocityMoments<Scalar>> moving;  ///< of those
  PerBody<Wrench<Scalar>> bias;             ///< wrench on those, at dnu/dt = 0
  PerJoint<Scalar> rate;                    ///< arm joint rates

 private:
  [[gnu::flatten]] void placeBase(const Vec8& q, const Velocities& nu) {
    constexpr int kAngles = kPositionDim - kYaw, kRoom = (kAngles + 7) / 8 * 8;
    Scalar angle[kRoom], sine[kRoom], cosine[kRoom];
    for (int i = 0; i < kAngles; ++i) angle[i] = q[kYaw + i];
    for (int i = kAngles; i < kRoom; ++i) angle[i] = Scalar(0);
    sinesAndCosines<kAngles>(angle, sine, cosine);
    sin_yaw = sine[0], sin_pitch = sine[1], sin_roll = sine[2];
    cos_yaw = cosine[0], cos_pitch = cosine[1], cos_roll = cosine[2];
    for (int i = 0; i < kArmJointCount; ++i) {
      sin_arm[i] = sine[3 + i];
      cos_arm[i] = cosine[3 + i];
    }
    R_WB << cos_yaw * cos_pitch, cos_yaw * sin_pitch * sin_roll - sin_yaw * cos_roll,
        cos_yaw * sin_pitch * cos_roll + sin_yaw * sin_roll,  //
        sin_yaw * cos_pitch, sin_yaw * sin_pitch * sin_roll + cos_yaw * cos_roll,
        sin_yaw * sin_pitch * cos_roll - cos_yaw * sin_roll,  //
        -sin_pitch, cos_pitch * sin_roll, cos_pitch * cos_roll;
    const Scalar curvature(1 / c_.ball_radius);
    rolling.col(0) = curvature * R_WB.row(1).transpose();
    rolling.col(1) = -curvature * R_WB.row(0).transpose();

    omega = nu.template segment<3>(kOmegaX);
    kappa = rolling * nu.template head<2>();
    if constexpr (kSpin) kappa += nu[kBallSpin] * R_WB.row(2).transpose();
    spin_momentum = G_ * (omega + rho_ * (omega - kappa));
    velocity[0] = {omega, Vec3::Zero()};
    composite[0] = {c_.base_mass, c_.base_first_moment.template cast<Scalar>(),
                    c_.base_second_moment.template cast<Scalar>()};
  }

  /// Places and moves each link from its parent.
  [[gnu::flatten]] void goOutward(const Vec8& q, const Velocities& nu) {
    R_BA3.setIdentity();
    Vec3 origin = Vec3::Zero();
    for (int i = 0; i < kArmJointCount; ++i) {
      const DynamicsConstants::Link& link = c_.arm[i];
      origin += R_BA3 * link.p_PJ_P.template cast<Scalar>();
      const Vec3 axis = R_BA3 * link.axis.template cast<Scalar>();
      if (link.slides) {
        joint[i] = {Vec3::Zero(), axis};
        origin += q[kArm1 + i] * axis;
      } else {
        joint[i] = {axis, cross(origin, axis)};
        R_BA3 = (R_BA3 * rotationAbout(link.axis, sin_arm[i], cos_arm[i])).eval();
      }

      const Vec3 com = origin + R_BA3 * link.com.template cast<Scalar>();
      const Vec3 first = Scalar(link.mass) * com;
      composite[i + 1] = {
          link.mass, first,
          R_BA3 * link.second_moment_cm.template cast<Scalar>() * R_BA3.transpose() +
              first * com.transpose()};
      rate[i] = nu[kArmRate1 + i];
      joint_rate[i] = cross(velocity[i], joint[i]);
      velocity[i + 1] = velocity[i] + joint[i] * rate[i];
    }
    p_KE = origin + R_BA3 * c_.p_A3E.template cast<Scalar>();
  }

  /// Sums masses and forces from the tip inwards.
  [[gnu::flatten]] void goInward() {
    // Acceleration of the frame at dnu/dt = 0; gravity is an upward acceleration of K.
    PerBody<Motion<Scalar>> acceleration;
    acceleration[0] = {Vec3::Zero(), Scalar(c_.gravity) * R_WB.row(2).transpose()};
    for (int i = 0; i < kArmJointCount; ++i) {
      acceleration[i + 1] = acceleration[i] + joint_rate[i] * rate[i];
    }
    for (int i = kArmJointCount; i >= 0; --i) {
      moving[i] = VelocityMoments<Scalar>(composite[i], velocity[i]);
      bias[i] = composite[i] * acceleration[i] + moving[i].coriolis(velocity[i].angular);
      if (i == kArmJointCount) continue;
      composite[i] += composite[i + 1];
      moving[i] += moving[i + 1];
      bias[i] = bias[i] + bias[i + 1];
    }
    for (int i = 0; i < kArmJointCount; ++i) joint_wrench[i] = composite[i + 1] * joint[i];
  }

  /// Rotation about a unit vector.
  static Mat3 rotationAbout(const Vector3& unit, const Scalar& s, const Scalar& c) {
    Mat3 R = (unit * unit.transpose()).template cast<Scalar>() * (Scalar(1) - c);
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      R(k, k) += c;
      R(j, i) += s * Scalar(unit[k]);
      R(i, j) -= s * Scalar(unit[k]);
    }
    return R;
  }

  const DynamicsConstants& c_;
  const Scalar rho_;
  const Mat3 G_;
};

}  // namespace ballbot
