#pragma once

#include "model/dynamics_lanes.hpp"
#include "model/inverse_mass.hpp"
#include "model/residual_derivatives.hpp"

// What the linearisations of ReducedDynamics and SpinningDynamics have in common, for four states
// at once. Linearization is that of either: f, df_dx, df_dtau and so on.

namespace ballbot {

/// dq/dt = T(q) nu and its derivatives.
template <bool kSpin, typename Linearization>
[[gnu::flatten]] void linearizeKinematics(const DynamicsLanes<kSpin>& lanes, Linearization* out) {
  const typename DynamicsLanes<kSpin>::Pass& p = lanes.pass;
  const Pack secant = Pack(1) / p.cos_pitch, tangent = p.sin_pitch * secant;
  const auto rates = p.eulerRates();
  const Pack yaw_rate = rates[0], pitch_rate = rates[1];

  Eigen::Matrix<Pack, kPositionDim, 1> dq = lanes.nu.template head<kVelocityDim>();
  dq.template segment<3>(kYaw) = rates;
  lanes.template put<kPositionDim>(dq.data(), out, [](Linearization& o) { return o.f.data(); });

  // Rows yaw, pitch, roll by pitch and roll, and by the three components of w; of the latter only
  // what is not constant.
  const auto column = [&](int k, const Pack& yaw, const Pack& pitch, const Pack& roll) {
    const Pack values[3] = {yaw, pitch, roll};
    lanes.template put<3>(values, out, [k](Linearization& o) { return &o.df_dx(kYaw, k); });
  };
  const Pack zero(0);
  column(kPitch, yaw_rate * tangent, zero, yaw_rate * secant);
  column(kRoll, pitch_rate * secant, -p.cos_pitch * yaw_rate, pitch_rate * tangent);
  column(kPositionDim + kOmegaY, p.sin_roll * secant, p.cos_roll, p.sin_roll * tangent);
  column(kPositionDim + kOmegaZ, p.cos_roll * secant, -p.sin_roll, p.cos_roll * tangent);
}

/// dnu/dt and its derivatives: M^-1 times those of the residual.
/// @param floor_torque  on the ball about the vertical, where it may spin; else null [N m]
template <bool kSpin, typename Linearization>
void linearizeDynamics(const DynamicsConstants& constants, const DynamicsLanes<kSpin>& lanes,
                       const JointVector* tau, const Vector3* lambda_W, const Vector3* moment_W,
                       const double* floor_torque, Linearization* out) {
  using Residual = ResidualDerivatives<Pack, kSpin>;
  using Pass = typename DynamicsLanes<kSpin>::Pass;
  const Pass& pass = lanes.pass;
  const auto torque = lanes.template gathered<0, kJointCount>(tau);
  const auto force = lanes.template gathered<0, 3>(lambda_W);
  const InverseMass<Pack, kSpin> inverse_mass(constants, pass);
  typename Pass::Velocities acceleration = pass.appliedForce(torque, force);
  if (moment_W) pass.addMoment(lanes.template gathered<0, 3>(moment_W), acceleration);
  acceleration -= pass.nonlinearEffects();
  if constexpr (kSpin) acceleration[kBallSpin] += lanes.gathered(floor_torque);
  inverse_mass.multiplyInPlace(acceleration);
  lanes.template put<Pass::kVelocities>(acceleration.data(), out,
                                        [](Linearization& o) { return o.f.data() + kPositionDim; });

  Residual residual(constants, pass, acceleration, torque, force);
  if (moment_W) {
    residual.addMoment(lanes.template gathered<0, 3>(moment_W));
    for (int k = 0; k < 3; ++k) {
      inverse_mass.multiplyInPlace(residual.by_moment.col(k));
      lanes.template put<Pass::kVelocities>(&residual.by_moment(0, k), out, [k](Linearization& o) {
        return &o.df_dmoment(kPositionDim, k);
      });
    }
  }
  for (int k = 0; k < Residual::kColumnCount; ++k) {
    inverse_mass.multiplyInPlace(residual.columns.col(k));
  }
  const auto column = [&](int k, auto&& address) {
    lanes.template put<Pass::kVelocities>(&residual.columns(0, k), out, address);
  };
  const auto byState = [&](int first, int count, int state) {
    for (int k = 0; k < count; ++k) {
      column(first + k, [=](Linearization& o) { return &o.df_dx(kPositionDim, state + k); });
    }
  };
  byState(Residual::kByEuler, 3, kYaw);
  byState(Residual::kByArm, kArmJointCount, kArm1);
  byState(Residual::kByVelocity, Pass::kVelocities, kPositionDim);
  for (int k = 0; k < kJointCount; ++k) {
    column(Residual::kByTorque + k, [k](Linearization& o) { return &o.df_dtau(kPositionDim, k); });
  }
  for (int k = 0; k < 3; ++k) {
    column(Residual::kByForce + k,
           [k](Linearization& o) { return &o.df_dlambda(kPositionDim, k); });
  }
  if constexpr (kSpin) {
    typename Pass::Velocities by_floor = Pass::Velocities::Unit(kBallSpin);
    inverse_mass.multiplyInPlace(by_floor);
    lanes.template put<Pass::kVelocities>(
        by_floor.data(), out, [](Linearization& o) { return o.df_dfloor.data() + kPositionDim; });
  } else {
    (void)floor_torque;
  }
}

}  // namespace ballbot
