#include "controller/lqr.hpp"

#include <cmath>

#include "core/config_visitor.hpp"
#include "model/dynamics_constants.hpp"
#include "solver/riccati_equation.hpp"

namespace ballbot {
namespace {

/// The value's P. A rigid arm's coordinates do not move and are no error: their rows and columns
/// are zero, and the equation is that of the others.
StateJacobian solveForValue(const StateJacobian& A, const StateJacobian& G, const StateJacobian& Q,
                            bool rigid_arm) {
  if (!rigid_arm) return solveContinuousRiccati<kStateDim>(A, G, Q);
  constexpr int kMoving = kPositionDim - kArmJointCount;
  Eigen::Matrix<double, kStateDim, 2 * kMoving> E;
  E.setZero();
  E.block<kMoving, kMoving>(0, 0).setIdentity();
  E.block<kMoving, kMoving>(kPositionDim, kMoving).setIdentity();
  return E *
         solveContinuousRiccati<2 * kMoving>(E.transpose() * A * E, E.transpose() * G * E,
                                             E.transpose() * Q * E) *
         E.transpose();
}

/// Two wheels balance or turn: what of yaw and ball they can bring to rest together is fixed by how
/// they began, a mode that no torque reaches. So yaw is made one that nothing moves and that moves
/// nothing.
void leaveYawAlone(ReducedDynamics::Linearization& model) {
  for (const int i : {int{kYaw}, kPositionDim + kOmegaZ}) {
    model.df_dx.row(i).setZero();
    model.df_dx.col(i).setZero();
    model.df_dx(i, i) = -1;
    model.df_dtau.row(i).setZero();
  }
}

}  // namespace

StateJacobian LqrWeights::stateWeight() const {
  StateVector diagonal;
  diagonal << ball_position, ball_position, yaw, tilt, tilt, ArmVector::Constant(arm_position),
      ball_velocity, ball_velocity, Vector3::Constant(base_rate), ArmVector::Constant(arm_rate);
  return diagonal.asDiagonal();
}

JointVector LqrWeights::torqueWeight() const {
  JointVector diagonal;
  diagonal << WheelVector::Constant(wheel_torque), ArmVector::Constant(arm_torque);
  return diagonal;
}

void LqrWeights::describe(ConfigVisitor& v) {
  v.number(may("ball_position",
               "weight of the ball's distance from its place; larger brings it back harder"),
           ball_position, {kTiny, 1e6});
  v.number(may("yaw", "weight of the error of the heading"), yaw, {kTiny, 1e6});
  v.number(may("tilt", "weight of the base's pitch and roll"), tilt, {0, 1e6});
  v.number(may("arm_position", "weight of each arm joint's distance from its angle"), arm_position,
           {kTiny, 1e6});
  v.number(may("ball_velocity", "weight of the ball's velocity; larger damps its way back"),
           ball_velocity, {0, 1e6});
  v.number(may("base_rate", "weight of the base's angular velocity"), base_rate, {0, 1e6});
  v.number(may("arm_rate", "weight of each arm joint's velocity"), arm_rate, {0, 1e6});
  v.number(may("wheel_torque", "weight of each wheel's torque; larger makes the loop slower"),
           wheel_torque, {kTiny, 1e6});
  v.number(may("arm_torque", "weight of each arm joint's torque; larger makes the arm softer"),
           arm_torque, {kTiny, 1e6});
}

LqrSolution designLqr(const ReducedDynamics& dynamics, const ArmVector& arm,
                      const LqrWeights& weights, const WheelFlags& lost) {
  LqrSolution out;
  out.equilibrium = findEquilibrium(dynamics, arm);

  ReducedDynamics::Linearization model;
  dynamics.linearize(out.equilibrium.x, out.equilibrium.tau, Vector3::Zero(), model);
  if (any(lost)) leaveYawAlone(model);
  const auto& B = model.df_dtau;
  // R^-1 B^T
  FeedbackGain R_inverse_Bt = weights.torqueWeight().cwiseInverse().asDiagonal() * B.transpose();
  for (int i = 0; i < kWheelCount; ++i) {
    if (lost[static_cast<std::size_t>(i)]) R_inverse_Bt.row(i).setZero();  // no price is too high
  }
  out.P = solveForValue(model.df_dx, B * R_inverse_Bt, weights.stateWeight(),
                        DynamicsConstants(dynamics.robot()).rigid_arm);
  out.K = -R_inverse_Bt * out.P;
  return out;
}

FeedbackGain gainAtYaw(const FeedbackGain& K, double yaw) {
  Eigen::Matrix2d to_heading;  // takes W coordinates to those of a frame turned by yaw
  to_heading << std::cos(yaw), std::sin(yaw), -std::sin(yaw), std::cos(yaw);
  FeedbackGain turned = K;
  turned.middleCols<2>(kBallX) = K.middleCols<2>(kBallX) * to_heading;
  turned.middleCols<2>(kPositionDim + kBallVx) =
      K.middleCols<2>(kPositionDim + kBallVx) * to_heading;
  return turned;
}

}  // namespace ballbot
