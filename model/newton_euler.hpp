#pragma once

#include <array>
#include <cmath>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// RobotParameters in the form the equations use, computed once.
struct DynamicsConstants {
  explicit DynamicsConstants(const RobotParameters& robot);

  struct Link {
    Vector3 p_PJ_P, axis, com;
    double mass;
    Matrix3 I_cm;
    double composite_mass;  ///< of this link and those beyond it
  };
  double base_mass;
  Vector3 base_com;
  Matrix3 base_I_cm;
  std::array<Link, kArmJointCount> arm;
  Vector3 p_A3E;
  Matrix3 R_A3E;

  double gravity, ball_radius;
  double rolling_mass;   ///< ball mass plus I_ball / r^2: its inertia against rolling [kg]
  double upper_mass;     ///< all that stands on the ball [kg]
  double ratio;          ///< rho = r / r_w
  Matrix3 axles;         ///< D, rows d_i
  Matrix3 spin_inertia;  ///< G = I_w sum d_i d_i^T [kg m^2]
};

/// Cross and dot product without the conjugation that Eigen's apply to complex scalars, which
/// would break complex-step differentiation.
template <typename A, typename B>
Eigen::Matrix<typename A::Scalar, 3, 1> cross(const A& a, const B& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename A, typename B>
typename A::Scalar dot(const A& a, const B& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Newton-Euler pass of the reduced model for one configuration. Everything is expressed in axes of
/// B, positions from K. Scalar is double, or a type that carries derivatives.
///
/// Wheels enter by their spin momentum G s, s = (1 + rho) w - rho kappa: G (d_i . w + phi_dot_i)
/// summed over the axles; their mass and transverse inertia belong to the base.
template <typename Scalar>
class NewtonEuler {
 public:
  using Vec3 = Eigen::Matrix<Scalar, 3, 1>;
  using Mat3 = Eigen::Matrix<Scalar, 3, 3>;
  using Vec8 = Eigen::Matrix<Scalar, kVelocityDim, 1>;
  using Mat8 = Eigen::Matrix<Scalar, kVelocityDim, kVelocityDim>;
  using Vec6 = Eigen::Matrix<Scalar, kJointCount, 1>;

  NewtonEuler(const DynamicsConstants& constants, const Vec8& q) : c_(constants) {
    using std::cos;
    using std::sin;
    const Scalar sz = sin(q[kYaw]), cz = cos(q[kYaw]), sy = sin(q[kPitch]), cy = cos(q[kPitch]),
                 sx = sin(q[kRoll]), cx = cos(q[kRoll]);
    R_WB << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
        sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,      //
        -sy, cy * sx, cy * cx;
    Mat3 R = Mat3::Identity();
    Vec3 origin = Vec3::Zero();
    for (int i = 0; i < kArmJointCount; ++i) {
      const DynamicsConstants::Link& link = c_.arm[i];
      origin += R * link.p_PJ_P.template cast<Scalar>();
      joint_origin[i] = origin;
      axis[i] = R * link.axis.template cast<Scalar>();
      R = R * rotationAbout(link.axis, q[kArm1 + i]);
      R_BA[i] = R;
      com[i] = origin + R * link.com.template cast<Scalar>();
      I_cm[i] = R * link.I_cm.template cast<Scalar>() * R.transpose();
    }
    p_KE = origin + R * c_.p_A3E.template cast<Scalar>();
    // R^T J_K: the ball's angular velocity in B per velocity of its centre.
    rolling.col(0) = R_WB.row(1).transpose() / Scalar(c_.ball_radius);
    rolling.col(1) = -R_WB.row(0).transpose() / Scalar(c_.ball_radius);
  }

  /// h(q, nu): what has to be applied for dnu/dt = 0.
  Vec8 nonlinearEffects(const Vec8& nu) const {
    const Vec3 w = nu.template segment<3>(kOmegaX);
    const Vec3 g = Scalar(c_.gravity) * R_WB.row(2).transpose();  // gravity as acceleration of K
    const Vec3 kappa = rolling * nu.template head<2>();

    // Outward: velocities and accelerations at dnu/dt = 0, then each body's force and moment about
    // its centre of mass.
    std::array<Vec3, kArmJointCount> force, moment;
    Vec3 w_link = w, dw_link = Vec3::Zero(), a_origin = g, p_origin = Vec3::Zero();
    for (int i = 0; i < kArmJointCount; ++i) {
      const Vec3 offset = joint_origin[i] - p_origin;
      a_origin += cross(dw_link, offset) + cross(w_link, cross(w_link, offset));
      p_origin = joint_origin[i];
      const Vec3 relative = axis[i] * nu[kArmRate1 + i];
      dw_link += cross(w_link, relative);
      w_link += relative;
      const Vec3 arm = com[i] - joint_origin[i];
      force[i] = Scalar(c_.arm[i].mass) *
                 (a_origin + cross(dw_link, arm) + cross(w_link, cross(w_link, arm)));
      moment[i] = I_cm[i] * dw_link + cross(w_link, Vec3(I_cm[i] * w_link));
    }

    // Inward: sums about K, which give the joint torques on the way.
    Vec8 h;
    Vec3 f = Vec3::Zero(), n = Vec3::Zero();
    for (int i = kArmJointCount - 1; i >= 0; --i) {
      f += force[i];
      n += moment[i] + cross(com[i], force[i]);
      h[kArmRate1 + i] = dot(axis[i], n - cross(joint_origin[i], f));
    }
    const Vec3 base_com = c_.base_com.template cast<Scalar>();
    const Mat3 base_I = c_.base_I_cm.template cast<Scalar>();
    const Vec3 base_force = Scalar(c_.base_mass) * (g + cross(w, cross(w, base_com)));
    f += base_force;
    n += cross(base_com, base_force) + cross(w, Vec3(base_I * w));

    const Mat3 G = c_.spin_inertia.template cast<Scalar>();
    const Scalar rho(c_.ratio);
    const Vec3 spin_torque = rho * (G * cross(w, kappa));
    const Vec3 momentum = G * ((Scalar(1) + rho) * w - rho * kappa);
    n += (Scalar(1) + rho) * spin_torque + cross(w, momentum);

    h.template head<2>() =
        (R_WB * f).template head<2>() - rho * (rolling.transpose() * spin_torque);
    h.template segment<3>(kOmegaX) = n;
    return h;
  }

  /// M(q), by composite rigid bodies.
  Mat8 massMatrix() const {
    Mat8 M = Mat8::Zero();
    Vec3 first = Vec3::Zero();   // first moment of the bodies so far, about K
    Mat3 second = Mat3::Zero();  // their inertia about K
    for (int i = kArmJointCount - 1; i >= 0; --i) {
      const DynamicsConstants::Link& link = c_.arm[i];
      add(link.mass, com[i], I_cm[i], first, second);
      // Unit acceleration of joint i: the field axis x p + b on all bodies beyond it.
      const Vec3 b = cross(joint_origin[i], axis[i]);
      const Vec3 force = cross(axis[i], first) + Scalar(link.composite_mass) * b;
      const Vec3 moment = second * axis[i] + cross(first, b);
      const int column = kArmRate1 + i;
      M.template block<2, 1>(kBallVx, column) = (R_WB * force).template head<2>();
      M.template block<3, 1>(kOmegaX, column) = moment;
      for (int j = 0; j <= i; ++j) {
        M(kArmRate1 + j, column) =
            dot(axis[j], moment) + dot(cross(joint_origin[j], axis[j]), force);
      }
    }
    add(c_.base_mass, c_.base_com.template cast<Scalar>(), c_.base_I_cm.template cast<Scalar>(),
        first, second);

    const Mat3 G = c_.spin_inertia.template cast<Scalar>();
    const Scalar rho(c_.ratio), one(1);
    const Eigen::Matrix<Scalar, 3, 2> G_rolling = G * rolling;
    for (int k = 0; k < 3; ++k) {
      const Vec3 force = cross(Vec3(Vec3::Unit(k)), first);
      M.template block<2, 1>(kBallVx, kOmegaX + k) =
          (R_WB * force).template head<2>() - rho * (one + rho) * G_rolling.row(k).transpose();
    }
    M.template block<3, 3>(kOmegaX, kOmegaX) = second + (one + rho) * (one + rho) * G;
    M.template topLeftCorner<2, 2>() =
        Scalar(c_.rolling_mass + c_.upper_mass) * Eigen::Matrix<Scalar, 2, 2>::Identity() +
        rho * rho * rolling.transpose() * G_rolling;
    M.template triangularView<Eigen::StrictlyLower>() = M.transpose();
    return M;
  }

  /// S(q)^T tau + J_E(q)^T lambda_W.
  Vec8 appliedForce(const Vec6& tau, const Vec3& lambda_W) const {
    const Vec3 ball_torque =
        -Scalar(c_.ratio) * (c_.axles.transpose().template cast<Scalar>() * tau.template head<3>());
    const Vec3 lambda = R_WB.transpose() * lambda_W;
    Vec8 force;
    force.template head<2>() = rolling.transpose() * ball_torque + lambda_W.template head<2>();
    force.template segment<3>(kOmegaX) = cross(p_KE, lambda) - ball_torque;
    for (int i = 0; i < kArmJointCount; ++i) {
      force[kArmRate1 + i] =
          tau[kWheelCount + i] + dot(cross(axis[i], p_KE - joint_origin[i]), lambda);
    }
    return force;
  }

  /// First moment of all that stands on the ball, from K [kg m].
  Vec3 firstMoment() const {
    Vec3 sum = Scalar(c_.base_mass) * c_.base_com.template cast<Scalar>();
    for (int i = 0; i < kArmJointCount; ++i) sum += Scalar(c_.arm[i].mass) * com[i];
    return sum;
  }

  Mat3 R_WB;
  std::array<Mat3, kArmJointCount> R_BA;          ///< takes link coordinates to B
  std::array<Vec3, kArmJointCount> axis;          ///< joint axes
  std::array<Vec3, kArmJointCount> joint_origin;  ///< from K
  std::array<Vec3, kArmJointCount> com;           ///< of the links, from K
  std::array<Mat3, kArmJointCount> I_cm;          ///< of the links, about their centres of mass
  Vec3 p_KE;
  Eigen::Matrix<Scalar, 3, 2> rolling;  ///< R^T J_K

 private:
  static Mat3 rotationAbout(const Vector3& unit, const Scalar& angle) {
    using std::cos;
    using std::sin;
    const Scalar s = sin(angle), c = cos(angle);
    Mat3 R = (unit * unit.transpose()).template cast<Scalar>() * (Scalar(1) - c);
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      R(k, k) += c;
      R(j, i) += s * Scalar(unit[k]);
      R(i, j) -= s * Scalar(unit[k]);
    }
    return R;
  }

  static void add(double mass, const Vec3& com, const Mat3& I_cm, Vec3& first, Mat3& second) {
    first += Scalar(mass) * com;
    second += I_cm + Scalar(mass) * (dot(com, com) * Mat3::Identity() - com * com.transpose());
  }

  const DynamicsConstants& c_;
};

}  // namespace ballbot
