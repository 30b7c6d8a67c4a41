#pragma once

#include "model/newton_euler.hpp"

namespace ballbot {

/// Derivatives of the dynamics' residual at one state,
///
///   r(q, nu, dnu) = M dnu + h - S^T tau - J_E^T (lambda, moment),
///
/// with dnu held, so that d(dnu) = -M^-1 dr. They are those of the Newton-Euler equations in closed
/// form (Singh, Russell, Wensing 2022; see spatial.hpp), for which the composite quantities of the
/// value pass suffice. Orientation enters as a small rotation delta about axes of B: it turns what
/// is fixed in W, that is gravity, the acceleration of K, lambda and the axes about which the ball
/// rolls, and nothing else.
///
/// kSpin: r has a ninth row and, by the spin, a ninth column of the velocities; its axis z turns
/// like those about which the ball rolls.
template <typename Scalar, bool kSpin = false>
class ResidualDerivatives {
 public:
  using Pass = NewtonEuler<Scalar, kSpin>;
  static constexpr int kVelocities = Pass::kVelocities;
  using Vec3 = typename Pass::Vec3;
  using Mat3 = typename Pass::Mat3;
  using Vec6 = typename Pass::Vec6;
  using Velocities = typename Pass::Velocities;

  /// Columns: by the variables that r depends on, then S^T and J_E^T.
  enum Column : int {
    kByEuler = 0,                           // yaw, pitch, roll
    kByArm = kByEuler + 3,                  // arm joint angles
    kByVelocity = kByArm + kArmJointCount,  // nu
    kByTorque = kByVelocity + kVelocities,
    kByForce = kByTorque + kJointCount,
    kColumnCount = kByForce + 3
  };
  Eigen::Matrix<Scalar, kVelocities, kColumnCount> columns;  ///< of -dr
  Eigen::Matrix<Scalar, kVelocities, 3> by_moment;           ///< set by addMoment()

  ResidualDerivatives(const DynamicsConstants& constants, const Pass& pass,
                      const Velocities& acceleration, const Vec6& tau, const Vec3& lambda_W)
      : c_(constants), p_(pass), rho_(constants.ratio), G_(constants.spin_inertia.cast<Scalar>()) {
    angular_ = acceleration.template segment<3>(kOmegaX);
    linear_ = acceleration[kBallVx] * p_.R_WB.row(0) + acceleration[kBallVy] * p_.R_WB.row(1);
    a_K_ = linear_ + Scalar(c_.gravity) * p_.R_WB.row(2).transpose();
    lambda_ = p_.R_WB.transpose() * lambda_W;
    for (int i = 0; i < kArmJointCount; ++i) tip_[i] = p_.tipVelocity(i);
    byArm(acceleration);
    byOrientation(acceleration, tau);
    byBaseVelocity();
    byInputs();
    if constexpr (kSpin) bySpin();
  }

  /// The part of a moment on the end-effector: without it there is none.
  [[gnu::flatten]] void addMoment(const Vec3& moment_W);

 private:
  /// skew(a) M and M skew(a).
  static Mat3 skewTimes(const Vec3& a, const Mat3& M) {
    Mat3 out;
    for (int k = 0; k < 3; ++k) out.col(k) = cross(a, M.col(k));
    return out;
  }
  static Mat3 timesSkew(const Mat3& M, const Vec3& a) {
    Mat3 out;
    for (int k = 0; k < 3; ++k) out.row(k) = cross(M.row(k), a).transpose();
    return out;
  }
  /// skew(a) skew(b) = b a^T - (a . b) 1.
  static Mat3 skewSkew(const Vec3& a, const Vec3& b) {
    Mat3 out = b * a.transpose();
    const Scalar product = dot(a, b);
    for (int k = 0; k < 3; ++k) out(k, k) -= product;
    return out;
  }
  static void subtractSkew(Mat3& M, const Vec3& a) {
    M(0, 1) += a[2], M(1, 0) -= a[2];
    M(1, 2) += a[0], M(2, 1) -= a[0];
    M(2, 0) += a[1], M(0, 2) -= a[1];
  }
  void setBaseRows(int column, const Wrench<Scalar>& w) {
    for (int k = 0; k < 2; ++k) columns(kBallVx + k, column) = -dot(p_.R_WB.row(k), w.force);
    columns.template block<3, 1>(kOmegaX, column) = -w.moment;
  }

  /// A row by delta as a row by yaw, pitch and roll.
  Vec3 byEuler(const Vec3& by_delta) const {
    const Vec3 yaw(-p_.sin_pitch, p_.cos_pitch * p_.sin_roll, p_.cos_pitch * p_.cos_roll);
    return {dot(by_delta, yaw), p_.cos_roll * by_delta[1] - p_.sin_roll * by_delta[2], by_delta[0]};
  }

  [[gnu::flatten]] void byArm(const Velocities& acceleration);
  [[gnu::flatten]] void byOrientation(const Velocities& acceleration, const Vec6& tau);
  [[gnu::flatten]] void byBaseVelocity();
  [[gnu::flatten]] void byInputs();
  /// The column of the spin, and of its row what does not stand beside the ball's other rows.
  [[gnu::flatten]] void bySpin();

  const DynamicsConstants& c_;
  const Pass& p_;
  const Scalar rho_;
  const Mat3 G_;
  Vec3 angular_, linear_;  ///< acceleration of the base: dw and that of K, in B
  Vec3 a_K_, lambda_;      ///< the latter with gravity, and the force on E, in B
  std::array<Vec3, kArmJointCount> tip_;
};

template <typename Scalar, bool kSpin>
void ResidualDerivatives<Scalar, kSpin>::byArm(const Velocities& acceleration) {
  // Accelerations with dnu, their part that comes from dnu, and the wrenches that go with them.
  typename Pass::template PerBody<Motion<Scalar>> actual, added;
  added[0] = {angular_, linear_};
  actual[0] = {angular_, a_K_};
  std::array<Motion<Scalar>, kArmJointCount> S_ddot;
  for (int i = 0; i < kArmJointCount; ++i) {
    const Motion<Scalar> driven = p_.joint[i] * acceleration[kArmRate1 + i];
    added[i + 1] = added[i] + driven;
    actual[i + 1] = actual[i] + driven + p_.joint_rate[i] * p_.rate[i];
    S_ddot[i] = cross(actual[i], p_.joint[i]) + cross(p_.velocity[i], p_.joint_rate[i]);
  }
  Wrench<Scalar> beyond;  // by the accelerations of the joints beyond
  for (int i = kArmJointCount - 1; i >= 0; --i) {
    Wrench<Scalar> total = p_.bias[i + 1] + p_.composite[i + 1] * added[i + 1];
    if (i < kArmJointCount - 1) total = total + beyond;
    const Wrench<Scalar> own = p_.joint_wrench[i] * acceleration[kArmRate1 + i];
    beyond = i < kArmJointCount - 1 ? beyond + own : own;

    const Motion<Scalar>& S = p_.joint[i];
    const Motion<Scalar> two_S_dot = p_.joint_rate[i] * Scalar(2);
    const VelocityMoments<Scalar>& moving = p_.moving[i + 1];
    Wrench<Scalar> by_angle =
        moving.coriolis(two_S_dot.angular) + p_.composite[i + 1] * S_ddot[i] + cross(S, total);
    by_angle.moment -= cross(tip_[i], lambda_);
    const Wrench<Scalar> by_rate =
        moving.coriolis(Vec3(Scalar(2) * S.angular)) + p_.composite[i + 1] * two_S_dot;
    setBaseRows(kByArm + i, by_angle);
    setBaseRows(kByVelocity + kArmRate1 + i, by_rate);
    for (int j = 0; j < i; ++j) {
      columns(kArmRate1 + j, kByArm + i) = -dot(p_.joint[j], by_angle);
      columns(kArmRate1 + j, kByVelocity + kArmRate1 + i) = -dot(p_.joint[j], by_rate);
    }

    // The row of this joint, for its own column and those before it.
    const Wrench<Scalar>& momentum = p_.joint_wrench[i];
    const Vec3 coriolis = Scalar(2) * moving.coriolisTransposed(S);
    const Vec3 tip_lambda = cross(tip_[i], lambda_);
    for (int j = 0; j <= i; ++j) {
      columns(kArmRate1 + i, kByArm + j) = dot(p_.joint[j].angular, tip_lambda) -
                                           dot(coriolis, p_.joint_rate[j].angular) -
                                           dot(S_ddot[j], momentum);
      columns(kArmRate1 + i, kByVelocity + kArmRate1 + j) =
          -dot(coriolis, p_.joint[j].angular) - Scalar(2) * dot(p_.joint_rate[j], momentum);
    }
    columns.template block<1, 3>(kArmRate1 + i, kByVelocity + kOmegaX) =
        (cross(p_.omega, momentum.moment) - coriolis).transpose();
  }
}

template <typename Scalar, bool kSpin>
void ResidualDerivatives<Scalar, kSpin>::byOrientation(const Velocities& acceleration,
                                                       const Vec6& tau) {
  // A vector v that is fixed in W changes by v x delta in B.
  Vec3 ball_acceleration =
      acceleration[kBallVx] * p_.rolling.col(0) + acceleration[kBallVy] * p_.rolling.col(1);
  if constexpr (kSpin) ball_acceleration += acceleration[kBallSpin] * p_.R_WB.row(2).transpose();
  Mat3 dspin_rate = skewSkew(p_.omega, p_.kappa);
  subtractSkew(dspin_rate, ball_acceleration);
  const Mat3 spin_torque = rho_ * (G_ * dspin_rate);  // of the rate of the wheels' momentum
  Mat3 dn = skewSkew(p_.composite[0].first, a_K_) - skewSkew(p_.p_KE, lambda_);
  dn += (Scalar(1) + rho_) * spin_torque;
  dn -= rho_ * skewTimes(p_.omega, timesSkew(G_, p_.kappa));

  // Force on the upper body less its share m a_K, which is fixed in W.
  Vec3 force = p_.bias[0].force -
               Scalar(p_.composite[0].mass * c_.gravity) * p_.R_WB.row(2).transpose() +
               cross(angular_, p_.composite[0].first);
  for (int i = 0; i < kArmJointCount; ++i) {
    force += p_.joint_wrench[i].force * acceleration[kArmRate1 + i];
  }
  const Vec3 spin_rate =
      angular_ + rho_ * (angular_ - ball_acceleration + cross(p_.omega, p_.kappa));
  const Vec3 ball_torque = p_.ballTorque(tau) + rho_ * (G_ * spin_rate);
  Eigen::Matrix<Scalar, 2, 3> dp;
  for (int k = 0; k < 2; ++k) {
    const Vec3 row = p_.R_WB.row(k).transpose();
    const Vec3 axis = p_.rolling.col(k);
    dp.row(k) = (cross(force, row) - cross(ball_torque, axis)).transpose() -
                rho_ * (axis.transpose() * spin_torque);
  }

  const auto setRow = [&](int row, const Vec3& by_delta) {
    columns.template block<1, 3>(row, kByEuler) = -byEuler(by_delta).transpose();
  };
  for (int k = 0; k < 2; ++k) setRow(kBallVx + k, dp.row(k).transpose());
  for (int k = 0; k < 3; ++k) setRow(kOmegaX + k, dn.row(k).transpose());
  for (int i = 0; i < kArmJointCount; ++i) {
    setRow(kArmRate1 + i, cross(p_.joint_wrench[i].force, a_K_) - cross(tip_[i], lambda_));
  }
  if constexpr (kSpin) {
    const Vec3 up = p_.R_WB.row(2).transpose();
    const Vec3 turned = spin_torque.transpose() * up;
    setRow(kBallSpin, -cross(ball_torque, up) - rho_ * turned);
  }
}

template <typename Scalar, bool kSpin>
void ResidualDerivatives<Scalar, kSpin>::byBaseVelocity() {
  const MassMoments<Scalar>& body = p_.composite[0];
  const VelocityMoments<Scalar>& moving = p_.moving[0];
  const Scalar one(1), two(2);

  // 2 B + I skew(w), and the wheels' momentum.
  const Mat3 G_kappa = timesSkew(G_, p_.kappa);
  Mat3 dn = (one + rho_) * (skewTimes(p_.omega, G_) - rho_ * G_kappa) - two * moving.Q -
            timesSkew(body.second, p_.omega);
  const Scalar twice_trace = two * moving.Q.trace();
  for (int k = 0; k < 3; ++k) dn(k, k) += twice_trace;
  subtractSkew(dn, p_.spin_momentum - body.second.trace() * p_.omega);
  columns.template block<3, 3>(kOmegaX, kByVelocity + kOmegaX) = -dn;

  // Force: -2 skew(momentum) - skew(first) skew(w); a row times skew(v) is row x v.
  const Vec3 two_momentum = two * moving.momentum;
  for (int k = 0; k < 2; ++k) {
    const Vec3 row = p_.R_WB.row(k).transpose();
    const Vec3 axis = p_.rolling.col(k);
    columns.template block<1, 3>(kBallVx + k, kByVelocity + kOmegaX) =
        (cross(row, two_momentum) + cross(cross(row, body.first), p_.omega)).transpose() -
        rho_ * rho_ * (axis.transpose() * G_kappa);

    const Vec3 turned = cross(p_.omega, axis);
    const Vec3 spun = G_ * turned;
    columns.template block<3, 1>(kOmegaX, kByVelocity + k) =
        rho_ * (cross(p_.omega, Vec3(G_ * axis)) - (one + rho_) * spun);
    for (int j = 0; j < 2; ++j) {
      columns(kBallVx + j, kByVelocity + k) = rho_ * rho_ * dot(p_.rolling.col(j), spun);
    }
  }
  columns.template block<kArmJointCount, 2>(kArmRate1, kByVelocity).setConstant(Scalar(0));
}

template <typename Scalar, bool kSpin>
void ResidualDerivatives<Scalar, kSpin>::byInputs() {
  columns.template middleCols<kJointCount>(kByTorque).setConstant(Scalar(0));
  for (int i = 0; i < kWheelCount; ++i) {
    const Vec3 arm = rho_ * c_.axles.row(i).transpose().template cast<Scalar>();
    for (int k = 0; k < 2; ++k) columns(kBallVx + k, kByTorque + i) = -dot(p_.rolling.col(k), arm);
    columns.template block<3, 1>(kOmegaX, kByTorque + i) = arm;
  }
  for (int i = 0; i < kArmJointCount; ++i) {
    columns(kArmRate1 + i, kByTorque + kWheelCount + i) = Scalar(1);
  }
  for (int k = 0; k < 3; ++k) {
    const Vec3 direction = p_.R_WB.row(k).transpose();  // of a force along axis k of W
    for (int j = 0; j < 2; ++j) columns(kBallVx + j, kByForce + k) = Scalar(j == k ? 1 : 0);
    columns.template block<3, 1>(kOmegaX, kByForce + k) = cross(p_.p_KE, direction);
    for (int i = 0; i < kArmJointCount; ++i) {
      columns(kArmRate1 + i, kByForce + k) = dot(tip_[i], direction);
    }
  }
}

template <typename Scalar, bool kSpin>
void ResidualDerivatives<Scalar, kSpin>::bySpin() {
  const Vec3 up = p_.R_WB.row(2).transpose();
  const Vec3 turned = cross(p_.omega, up);
  const Vec3 spun = G_ * turned;
  const int column = kByVelocity + kBallSpin;
  for (int j = 0; j < 2; ++j) {
    const Vec3 axis = p_.rolling.col(j);
    columns(kBallVx + j, column) = rho_ * rho_ * dot(axis, spun);
    columns(kBallSpin, kByVelocity + kBallVx + j) =
        rho_ * rho_ * dot(up, Vec3(G_ * cross(p_.omega, axis)));
  }
  columns.template block<3, 1>(kOmegaX, column) =
      rho_ * (cross(p_.omega, Vec3(G_ * up)) - (Scalar(1) + rho_) * spun);
  columns(kBallSpin, column) = rho_ * rho_ * dot(up, spun);
  columns.template block<1, 3>(kBallSpin, kByVelocity + kOmegaX) =
      -rho_ * rho_ * (up.transpose() * timesSkew(G_, p_.kappa));
  for (int i = 0; i < kArmJointCount; ++i) {
    columns(kArmRate1 + i, column) = Scalar(0);
    columns(kBallSpin, kByVelocity + kArmRate1 + i) = Scalar(0);
    columns(kBallSpin, kByArm + i) = Scalar(0);
  }
  for (int i = 0; i < kWheelCount; ++i) {
    const Vec3 arm = rho_ * c_.axles.row(i).transpose().template cast<Scalar>();
    columns(kBallSpin, kByTorque + i) = -dot(up, arm);
  }
  for (int k = 0; k < 3; ++k) columns(kBallSpin, kByForce + k) = Scalar(0);
}

template <typename Scalar, bool kSpin>
void ResidualDerivatives<Scalar, kSpin>::addMoment(const Vec3& moment_W) {
  const Vec3 moment = p_.R_WB.transpose() * moment_W;  // changes by moment x delta
  const Vec3 skew_rows[3] = {Vec3(Scalar(0), -moment[2], moment[1]),
                             Vec3(moment[2], Scalar(0), -moment[0]),
                             Vec3(-moment[1], moment[0], Scalar(0))};
  for (int k = 0; k < 3; ++k) {
    columns.template block<1, 3>(kOmegaX + k, kByEuler) += byEuler(skew_rows[k]).transpose();
  }
  for (int i = 0; i < kArmJointCount; ++i) {
    const Vec3& axis = p_.joint[i].angular;
    const Vec3 turned = cross(axis, moment);  // of the axis by a joint before it, and by delta
    columns.template block<1, 3>(kArmRate1 + i, kByEuler) += byEuler(turned).transpose();
    for (int j = 0; j < i; ++j) {
      columns(kArmRate1 + i, kByArm + j) += dot(p_.joint[j].angular, turned);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const Vec3 direction = p_.R_WB.row(k).transpose();
    for (int j = 0; j < 2; ++j) by_moment(kBallVx + j, k) = Scalar(0);
    if constexpr (kSpin) by_moment(kBallSpin, k) = Scalar(0);
    by_moment.template block<3, 1>(kOmegaX, k) = direction;
    for (int i = 0; i < kArmJointCount; ++i) {
      by_moment(kArmRate1 + i, k) = dot(p_.joint[i].angular, direction);
    }
  }
}

}  // namespace ballbot
