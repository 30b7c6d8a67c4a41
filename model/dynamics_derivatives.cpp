#include "model/dynamics_lanes.hpp"
#include "model/end_effector.hpp"
#include "model/inverse_mass.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/residual_derivatives.hpp"

namespace ballbot {
namespace {

using Linearization = ReducedDynamics::Linearization;
using EndEffectorLinearization = ReducedDynamics::EndEffectorLinearization;

/// dq/dt = T(q) nu and its derivatives.
[[gnu::flatten]] void linearizeKinematics(const DynamicsLanes& lanes, Linearization* out) {
  const DynamicsLanes::Pass& p = lanes.pass;
  const Pack secant = Pack(1) / p.cos_pitch, tangent = p.sin_pitch * secant;
  const auto rates = p.eulerRates();
  const Pack yaw_rate = rates[0], pitch_rate = rates[1];

  Eigen::Matrix<Pack, kPositionDim, 1> dq = lanes.nu;
  dq.segment<3>(kYaw) = rates;
  lanes.put<kPositionDim>(dq.data(), out, [](Linearization& o) { return o.f.data(); });

  // Rows yaw, pitch, roll by pitch and roll, and by the three components of w; of the latter only
  // what is not constant.
  const auto column = [&](int k, const Pack& yaw, const Pack& pitch, const Pack& roll) {
    const Pack values[3] = {yaw, pitch, roll};
    lanes.put<3>(values, out, [k](Linearization& o) { return &o.df_dx(kYaw, k); });
  };
  const Pack zero(0);
  column(kPitch, yaw_rate * tangent, zero, yaw_rate * secant);
  column(kRoll, pitch_rate * secant, -p.cos_pitch * yaw_rate, pitch_rate * tangent);
  column(kPositionDim + kOmegaY, p.sin_roll * secant, p.cos_roll, p.sin_roll * tangent);
  column(kPositionDim + kOmegaZ, p.cos_roll * secant, -p.sin_roll, p.cos_roll * tangent);
}

/// dnu/dt and its derivatives: M^-1 times those of the residual.
void linearizeDynamics(const DynamicsConstants& constants, const DynamicsLanes& lanes,
                       const JointVector* tau, const Vector3* lambda_W, const Vector3* moment_W,
                       Linearization* out) {
  using Residual = ResidualDerivatives<Pack>;
  const DynamicsLanes::Pass& pass = lanes.pass;
  const auto torque = lanes.gathered<0, kJointCount>(tau);
  const auto force = lanes.gathered<0, 3>(lambda_W);
  const InverseMass<Pack> inverse_mass(constants, pass);
  DynamicsLanes::Pass::Vec8 acceleration = pass.appliedForce(torque, force);
  if (moment_W) pass.addMoment(lanes.gathered<0, 3>(moment_W), acceleration);
  acceleration -= pass.nonlinearEffects();
  inverse_mass.multiplyInPlace(acceleration);
  lanes.put<kVelocityDim>(acceleration.data(), out,
                          [](Linearization& o) { return o.f.data() + kPositionDim; });

  Residual residual(constants, pass, acceleration, torque, force);
  if (moment_W) {
    residual.addMoment(lanes.gathered<0, 3>(moment_W));
    for (int k = 0; k < 3; ++k) {
      inverse_mass.multiplyInPlace(residual.by_moment.col(k));
      lanes.put<kVelocityDim>(&residual.by_moment(0, k), out,
                              [k](Linearization& o) { return &o.df_dmoment(kPositionDim, k); });
    }
  }
  for (int k = 0; k < Residual::kColumnCount; ++k) {
    inverse_mass.multiplyInPlace(residual.columns.col(k));
  }
  const auto column = [&](int k, auto&& address) {
    lanes.put<kVelocityDim>(&residual.columns(0, k), out, address);
  };
  const auto byState = [&](int first, int count, int state) {
    for (int k = 0; k < count; ++k) {
      column(first + k, [=](Linearization& o) { return &o.df_dx(kPositionDim, state + k); });
    }
  };
  byState(Residual::kByEuler, 3, kYaw);
  byState(Residual::kByArm, kArmJointCount, kArm1);
  byState(Residual::kByVelocity, kVelocityDim, kPositionDim);
  for (int k = 0; k < kJointCount; ++k) {
    column(Residual::kByTorque + k, [k](Linearization& o) { return &o.df_dtau(kPositionDim, k); });
  }
  for (int k = 0; k < 3; ++k) {
    column(Residual::kByForce + k,
           [k](Linearization& o) { return &o.df_dlambda(kPositionDim, k); });
  }
}

[[gnu::flatten]] void linearizeTip(const DynamicsConstants& constants, const DynamicsLanes& lanes,
                                   const StateVector* x, EndEffectorLinearization* out) {
  using Output = EndEffectorLinearization;
  const EndEffectorKinematics<Pack> E(constants, lanes.pass, lanes.gathered<kBallX, 2>(x),
                                      lanes.gathered<kPositionDim + kBallVx, 2>(x));
  lanes.put<3>(E.position.data(), out, [](Output& o) { return o.value.p_WE.data(); });
  lanes.put<9>(E.rotation.data(), out, [](Output& o) { return o.value.R_WE.data(); });
  lanes.put<3>(E.velocity.data(), out, [](Output& o) { return o.value.v_WE_W.data(); });
  lanes.put<3>(E.angular_velocity.data(), out, [](Output& o) { return o.value.w_WE_W.data(); });

  const auto put = [&](const EndEffectorKinematics<Pack>::Vec6& motion,
                       EndEffectorJacobian Output::*jacobian, int k) {
    lanes.put<6>(motion.data(), out, [=](Output& o) { return &(o.*jacobian)(0, k); });
  };
  for (int k = 0; k < 3; ++k) {
    put(E.byOmega(k), &Output::jacobian, kOmegaX + k);
    put(E.byEuler(k), &Output::dpose_dq, kYaw + k);
    put(E.twistByEuler(k), &Output::dtwist_dq, kYaw + k);
  }
  for (int i = 0; i < kArmJointCount; ++i) {
    const auto motion = E.byArm(i);
    put(motion, &Output::jacobian, kArmRate1 + i);
    put(motion, &Output::dpose_dq, kArm1 + i);
    put(E.twistByArm(i), &Output::dtwist_dq, kArm1 + i);
  }
}

}  // namespace

ReducedDynamics::Linearization::Linearization() {
  for (const int i : {+kBallX, +kBallY, +kArm1, +kArm2, +kArm3}) df_dx(i, kPositionDim + i) = 1;
  df_dx(kRoll, kPositionDim + kOmegaX) = 1;
}

ReducedDynamics::EndEffectorLinearization::EndEffectorLinearization() {
  jacobian(0, kBallVx) = jacobian(1, kBallVy) = 1;
  dpose_dq(0, kBallX) = dpose_dq(1, kBallY) = 1;
}

void ReducedDynamics::linearize(int count, const StateVector* x, const JointVector* tau,
                                const Vector3* lambda_W, Linearization* out,
                                EndEffectorLinearization* end_effector,
                                const Vector3* moment_W) const {
  for (int first = 0; first < count; first += Pack::kLanes) {
    const DynamicsLanes lanes(*constants_, first, count, x);
    linearizeKinematics(lanes, out);
    linearizeDynamics(*constants_, lanes, tau, lambda_W, moment_W, out);
    if (end_effector) linearizeTip(*constants_, lanes, x, end_effector);
  }
}

void ReducedDynamics::linearize(const StateVector& x, const JointVector& tau,
                                const Vector3& lambda_W, Linearization& out,
                                const Vector3* moment_W) const {
  linearize(1, &x, &tau, &lambda_W, &out, nullptr, moment_W);
}

void ReducedDynamics::linearizeEndEffector(const StateVector& x,
                                           EndEffectorLinearization& out) const {
  linearizeEndEffector(1, &x, &out);
}

void ReducedDynamics::linearizeEndEffector(int count, const StateVector* x,
                                           EndEffectorLinearization* out) const {
  for (int first = 0; first < count; first += Pack::kLanes) {
    linearizeTip(*constants_, DynamicsLanes(*constants_, first, count, x), x, out);
  }
}

}  // namespace ballbot
