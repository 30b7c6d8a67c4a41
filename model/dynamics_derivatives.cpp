#include "model/dynamics_linearization.hpp"
#include "model/end_effector.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {
namespace {

using EndEffectorLinearization = ReducedDynamics::EndEffectorLinearization;

[[gnu::flatten]] void linearizeTip(const DynamicsConstants& constants, const DynamicsLanes<>& lanes,
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
  for (const int i : {+kBallX, +kBallY}) df_dx(i, kPositionDim + i) = 1;
  for (int i = kArm1; i < kPositionDim; ++i) df_dx(i, kPositionDim + i) = 1;
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
    const DynamicsLanes<> lanes(*constants_, first, count, x);
    linearizeKinematics(lanes, out);
    linearizeDynamics(*constants_, lanes, tau, lambda_W, moment_W, nullptr, out);
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
    linearizeTip(*constants_, DynamicsLanes<>(*constants_, first, count, x), x, out);
  }
}

}  // namespace ballbot
