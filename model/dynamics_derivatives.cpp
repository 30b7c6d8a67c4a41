#include "model/end_effector.hpp"
#include "model/mass_matrix_inverse.hpp"
#include "model/newton_euler.hpp"
#include "model/reduced_dynamics.hpp"

// Derivatives of the forward dynamics. With the residual
//
//   r(q, nu, dnu) = M dnu + h - S^T tau - J_E^T lambda = 0
//
// one has d(dnu) = -M^-1 (dr with dnu held). The derivatives of r are those of the Newton-Euler
// equations in closed form (Singh, Russell, Wensing 2022), for which the composite quantities of
// the value pass suffice. Orientation enters as a small rotation delta about axes of B: it turns
// what is fixed in W, that is gravity, the acceleration of K, lambda and the axes of the rolling
// ball, and nothing else.

namespace ballbot {
namespace {

using Pass = NewtonEuler<double>;
using Vec3 = Vector3;

/// Columns of r's derivatives, and of S^T and J_E^T, which get the same treatment.
enum Column : int {
  kEuler = 0,            // yaw, pitch, roll
  kArm = kEuler + 3,     // arm joints
  kVelocity = kArm + 3,  // nu
  kTorque = kVelocity + kVelocityDim,
  kForce = kTorque + kJointCount,
  kColumnCount = kForce + 3
};
using Columns = Eigen::Matrix<double, kVelocityDim, kColumnCount>;

Matrix3 skewOf(const Vec3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

class ResidualDerivatives {
 public:
  ResidualDerivatives(const DynamicsConstants& constants, const Pass& pass)
      : c_(constants), p_(pass) {}

  void compute(const VelocityVector& acceleration, const JointVector& tau, const Vec3& lambda_W);

  Columns columns;  ///< of -dr, so that M^-1 columns = d(dnu)

 private:
  void rotations(const VelocityVector& acceleration, const JointVector& tau, const Vec3& lambda_W);
  void joints(const VelocityVector& acceleration, const Vec3& lambda_W);
  void baseVelocity();
  void inputs();
  void setBaseRows(int column, const Wrench<double>& w) {
    columns.block<2, 1>(kBallVx, column) = -(p_.R_WB * w.force).head<2>();
    columns.block<3, 1>(kOmegaX, column) = -w.moment;
  }

  const DynamicsConstants& c_;
  const Pass& p_;
};

void ResidualDerivatives::compute(const VelocityVector& acceleration, const JointVector& tau,
                                  const Vec3& lambda_W) {
  joints(acceleration, lambda_W);
  rotations(acceleration, tau, lambda_W);
  baseVelocity();
  inputs();
}

void ResidualDerivatives::joints(const VelocityVector& acceleration, const Vec3& lambda_W) {
  const Vec3 lambda = p_.R_WB.transpose() * lambda_W;
  // True accelerations and wrenches, from those at dnu = 0.
  std::array<Motion<double>, 4> actual, added;
  added[0] = {acceleration.segment<3>(kOmegaX),
              p_.R_WB.topRows<2>().transpose() * acceleration.head<2>()};
  actual[0] = {added[0].angular, added[0].linear + c_.gravity * p_.R_WB.row(2).transpose()};
  for (int i = 0; i < kArmJointCount; ++i) {
    added[i + 1] = added[i] + p_.joint[i] * acceleration[kArmRate1 + i];
    actual[i + 1] =
        actual[i] + p_.joint[i] * acceleration[kArmRate1 + i] + p_.joint_rate[i] * p_.rate[i];
  }
  Wrench<double> beyond{Vec3::Zero(), Vec3::Zero()};
  std::array<Wrench<double>, kArmJointCount> total;
  for (int i = kArmJointCount - 1; i >= 0; --i) {
    total[i] = p_.bias[i + 1] + p_.composite[i + 1] * added[i + 1] + beyond;
    beyond = beyond + p_.joint_wrench[i] * acceleration[kArmRate1 + i];
  }

  for (int i = 0; i < kArmJointCount; ++i) {
    const Motion<double>& S = p_.joint[i];
    const Motion<double>& S_dot = p_.joint_rate[i];
    const Motion<double> two_S_dot = S_dot * 2.0;
    const Motion<double> S_ddot = cross(actual[i], S) + cross(p_.velocity[i], S_dot);
    const Vec3 tip = p_.tipVelocity(i);
    const auto& moving = p_.moving[i + 1];

    Wrench<double> by_angle =
        moving.coriolis(two_S_dot.angular) + p_.composite[i + 1] * S_ddot + cross(S, total[i]);
    by_angle.moment -= cross(tip, lambda);
    const Wrench<double> by_rate =
        moving.coriolis(Vec3(2 * S.angular)) + p_.composite[i + 1] * two_S_dot;
    setBaseRows(kArm + i, by_angle);
    setBaseRows(kVelocity + kArmRate1 + i, by_rate);
    for (int j = 0; j < i; ++j) {
      columns(kArmRate1 + j, kArm + i) = -dot(p_.joint[j], by_angle);
      columns(kArmRate1 + j, kVelocity + kArmRate1 + i) = -dot(p_.joint[j], by_rate);
    }
    // Rows of this joint, for the columns of those before it and its own.
    const Wrench<double>& momentum = p_.joint_wrench[i];
    const Vec3 coriolis = 2 * moving.coriolisTransposed(S);
    for (int j = 0; j <= i; ++j) {
      const Motion<double>& other_dot = p_.joint_rate[j];
      const Motion<double> other_ddot =
          cross(actual[j], p_.joint[j]) + cross(p_.velocity[j], other_dot);
      columns(kArmRate1 + i, kArm + j) =
          -(dot(coriolis, other_dot.angular) + dot(other_ddot, momentum) -
            dot(cross(p_.joint[j].angular, tip), lambda));
      columns(kArmRate1 + i, kVelocity + kArmRate1 + j) =
          -(dot(coriolis, p_.joint[j].angular) + 2 * dot(other_dot, momentum));
    }
    const Vec3 by_omega = coriolis + cross(momentum.moment, p_.omega);
    columns.block<1, 3>(kArmRate1 + i, kVelocity + kOmegaX) = -by_omega.transpose();
  }
}

void ResidualDerivatives::rotations(const VelocityVector& acceleration, const JointVector& tau,
                                    const Vec3& lambda_W) {
  const Matrix3& R = p_.R_WB;
  const double rho = c_.ratio;
  const Matrix3& G = c_.spin_inertia;
  const Vec3 lambda = R.transpose() * lambda_W;
  const Vec3 a_K =
      R.topRows<2>().transpose() * acceleration.head<2>() + c_.gravity * R.row(2).transpose();
  const Vec3 ball_acceleration = p_.rolling * acceleration.head<2>();  // R^T J_K times that of K

  // What turns against B by delta changes by v x delta.
  const Matrix3 dG_momentum = -rho * G * skewOf(p_.kappa);
  const Matrix3 dspin_rate =
      rho * (skewOf(p_.omega) * skewOf(p_.kappa) - skewOf(ball_acceleration));
  Matrix3 dn = skewOf(p_.composite[0].first) * skewOf(a_K) - skewOf(p_.p_KE) * skewOf(lambda) +
               (1 + rho) * G * dspin_rate + skewOf(p_.omega) * dG_momentum;

  // Force on the upper body less its share m a_K, which is constant in W.
  Wrench<double> total = p_.bias[0];
  const Motion<double> angular{acceleration.segment<3>(kOmegaX), Vec3::Zero()};
  total = total + p_.composite[0] * angular;
  for (int i = 0; i < kArmJointCount; ++i) {
    total = total + p_.joint_wrench[i] * acceleration[kArmRate1 + i];
  }
  const Vec3 force = total.force - p_.composite[0].mass * c_.gravity * R.row(2).transpose();
  const Vec3 spin_rate = (1 + rho) * acceleration.segment<3>(kOmegaX) - rho * ball_acceleration +
                         rho * cross(p_.omega, p_.kappa);
  const Vec3 torque = -rho * (G * spin_rate) - p_.ballTorque(tau);
  Eigen::Matrix<double, 2, 3> dp =
      -(R * skewOf(force)).topRows<2>() - rho * (p_.rolling.transpose() * (G * dspin_rate));
  for (int k = 0; k < 2; ++k) dp.row(k) += cross(torque, p_.rolling.col(k)).transpose();

  Matrix3 da;
  for (int i = 0; i < kArmJointCount; ++i) {
    da.row(i) =
        (cross(p_.joint_wrench[i].force, a_K) - cross(p_.tipVelocity(i), lambda)).transpose();
  }

  // delta of the rates of yaw, pitch and roll.
  Matrix3 E;
  E << -p_.sin_pitch, 0, 1,                        //
      p_.sin_roll * p_.cos_pitch, p_.cos_roll, 0,  //
      p_.cos_roll * p_.cos_pitch, -p_.sin_roll, 0;
  columns.block<2, 3>(kBallVx, kEuler) = -dp * E;
  columns.block<3, 3>(kOmegaX, kEuler) = -dn * E;
  columns.block<3, 3>(kArmRate1, kEuler) = -da * E;
}

void ResidualDerivatives::baseVelocity() {
  const double rho = c_.ratio;
  const Matrix3& G = c_.spin_inertia;
  const Matrix3 W = skewOf(p_.omega), H = skewOf(p_.composite[0].first);
  const auto& moving = p_.moving[0];

  Matrix3 dn = 2 * (moving.Q.trace() * Matrix3::Identity() - moving.Q);
  dn += p_.composite[0].second.trace() * W - p_.composite[0].second * W;
  const Matrix3 G_kappa = G * skewOf(p_.kappa);
  dn += (1 + rho) * (W * G - rho * G_kappa) - skewOf(p_.spin_momentum);
  const Matrix3 df = -2 * skewOf(moving.momentum) - H * W;
  columns.block<3, 3>(kOmegaX, kVelocity + kOmegaX) = -dn;
  columns.block<2, 3>(kBallVx, kVelocity + kOmegaX) =
      -(p_.R_WB.topRows<2>() * df + rho * rho * (p_.rolling.transpose() * G_kappa));

  const Eigen::Matrix<double, 3, 2> W_rolling = W * p_.rolling, G_rolling = G * p_.rolling;
  columns.block<3, 2>(kOmegaX, kVelocity) = -rho * ((1 + rho) * (G * W_rolling) - W * G_rolling);
  columns.block<2, 2>(kBallVx, kVelocity) = rho * rho * (G_rolling.transpose() * W_rolling);
  columns.block<3, 2>(kArmRate1, kVelocity).setZero();
}

void ResidualDerivatives::inputs() {
  columns.middleCols<kJointCount>(kTorque).setZero();
  columns.block<2, 3>(kBallVx, kTorque) = -c_.ratio * (c_.axles * p_.rolling).transpose();
  columns.block<3, 3>(kOmegaX, kTorque) = c_.ratio * c_.axles.transpose();
  columns.block<3, 3>(kArmRate1, kTorque + kWheelCount).setIdentity();
  columns.block<2, 3>(kBallVx, kForce) = Eigen::Matrix<double, 2, 3>::Identity();
  columns.block<3, 3>(kOmegaX, kForce) = skewOf(p_.p_KE) * p_.R_WB.transpose();
  for (int i = 0; i < kArmJointCount; ++i) {
    columns.block<1, 3>(kArmRate1 + i, kForce) = (p_.R_WB * p_.tipVelocity(i)).transpose();
  }
}

/// dq/dt = T(q) nu and its derivatives.
void linearizeKinematics(const Pass& pass, const VelocityVector& nu,
                         ReducedDynamics::Linearization& out) {
  const double sx = pass.sin_roll, cx = pass.cos_roll, sy = pass.sin_pitch, cy = pass.cos_pitch;
  const double secant = 1 / cy, tangent = sy * secant;
  const double yaw_rate = (sx * nu[kOmegaY] + cx * nu[kOmegaZ]) * secant;
  const double pitch_rate = cx * nu[kOmegaY] - sx * nu[kOmegaZ];
  out.f.head<kPositionDim>() = nu;
  out.f[kYaw] = yaw_rate;
  out.f[kPitch] = pitch_rate;
  out.f[kRoll] = nu[kOmegaX] + sy * yaw_rate;

  StateJacobian& A = out.df_dx;
  A(kYaw, kPitch) = yaw_rate * tangent;
  A(kRoll, kPitch) = yaw_rate * secant;
  A(kYaw, kRoll) = pitch_rate * secant;
  A(kPitch, kRoll) = -cy * yaw_rate;
  A(kRoll, kRoll) = pitch_rate * tangent;
  for (int i = 0; i < kPositionDim; ++i) {
    if (i < kYaw || i > kRoll) A(i, kPositionDim + i) = 1;
  }
  A(kYaw, kPositionDim + kOmegaY) = sx * secant;
  A(kYaw, kPositionDim + kOmegaZ) = cx * secant;
  A(kPitch, kPositionDim + kOmegaY) = cx;
  A(kPitch, kPositionDim + kOmegaZ) = -sx;
  A(kRoll, kPositionDim + kOmegaX) = 1;
  A(kRoll, kPositionDim + kOmegaY) = sx * tangent;
  A(kRoll, kPositionDim + kOmegaZ) = cx * tangent;
}

void linearizeAt(const DynamicsConstants& constants, const Pass& pass, const VelocityVector& nu,
                 const JointVector& tau, const Vec3& lambda_W,
                 ReducedDynamics::Linearization& out) {
  const MassMatrix M_inverse = inverseOfPositiveDefinite(pass.massMatrix());
  const VelocityVector acceleration =
      M_inverse * (pass.appliedForce(tau, lambda_W) - pass.nonlinearEffects());
  ResidualDerivatives residual(constants, pass);
  residual.compute(acceleration, tau, lambda_W);
  const Columns d = M_inverse * residual.columns;

  out.f.tail<kVelocityDim>() = acceleration;
  linearizeKinematics(pass, nu, out);
  out.df_dx.block<kVelocityDim, 3>(kPositionDim, kYaw) = d.middleCols<3>(kEuler);
  out.df_dx.block<kVelocityDim, 3>(kPositionDim, kArm1) = d.middleCols<3>(kArm);
  out.df_dx.bottomRightCorner<kVelocityDim, kVelocityDim>() = d.middleCols<kVelocityDim>(kVelocity);
  out.df_dtau.bottomRows<kVelocityDim>() = d.middleCols<kJointCount>(kTorque);
  out.df_dlambda.bottomRows<kVelocityDim>() = d.middleCols<3>(kForce);
}

}  // namespace

void ReducedDynamics::linearize(const StateVector& x, const JointVector& tau,
                                const Vector3& lambda_W, Linearization& out) const {
  const Pass pass(*constants_, x.head<kPositionDim>(), x.tail<kVelocityDim>());
  linearizeAt(*constants_, pass, x.tail<kVelocityDim>(), tau, lambda_W, out);
}

void ReducedDynamics::linearize(const StateVector& x, const JointVector& tau,
                                const Vector3& lambda_W, Linearization& out,
                                EndEffectorLinearization& end_effector) const {
  const Pass pass(*constants_, x.head<kPositionDim>(), x.tail<kVelocityDim>());
  linearizeAt(*constants_, pass, x.tail<kVelocityDim>(), tau, lambda_W, out);
  linearizeEndEffectorOf(*constants_, pass, x, end_effector);
}

}  // namespace ballbot
