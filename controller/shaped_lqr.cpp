#include "controller/shaped_lqr.hpp"

#include "solver/riccati_equation.hpp"
#include "solver/vector_kernels.hpp"

namespace ballbot {

ShapedLqr designShapedLqr(const ReducedDynamics& dynamics, const ArmVector& arm,
                          const StateJacobian& Q, const JointVector& torque_weight,
                          const FrequencyShaping& shaping) {
  using Matrix = Eigen::Matrix<double, kMpcStateDim, kMpcStateDim>;
  using InputMatrix = Eigen::Matrix<double, kMpcStateDim, kJointCount>;
  ShapedLqr out;
  out.shaping = shaping;
  out.equilibrium = findEquilibrium(dynamics, arm);
  dynamics.linearize(out.equilibrium.x, out.equilibrium.tau, Vector3::Zero(), out.model);

  // x_f' = pole (u - x_f); cost 1/2 R (rho u - (rho - 1) x_f)^2 on the wheels.
  Matrix A = Matrix::Zero(), Qz = Matrix::Zero();
  InputMatrix B = InputMatrix::Zero(), N = InputMatrix::Zero();
  A.topLeftCorner<kStateDim, kStateDim>() = out.model.df_dx;
  B.topRows<kStateDim>() = out.model.df_dtau;
  Qz.topLeftCorner<kStateDim, kStateDim>() = Q;
  JointVector R = torque_weight;
  const double rho = shaping.rho();
  for (int i = 0; i < kFilterDim; ++i) {
    const int f = kStateDim + i;
    A(f, f) = -shaping.pole;
    B(f, i) = shaping.pole;
    Qz(f, f) = (rho - 1) * (rho - 1) * torque_weight[i];
    N(f, i) = -rho * (rho - 1) * torque_weight[i];
    R[i] *= rho * rho;
  }
  // u = v - R^-1 N^T z removes the cross term.
  const Eigen::Matrix<double, kJointCount, kMpcStateDim> R_inverse_Nt =
      R.cwiseInverse().asDiagonal() * N.transpose();
  const Eigen::Matrix<double, kJointCount, kMpcStateDim> R_inverse_Bt =
      R.cwiseInverse().asDiagonal() * B.transpose();
  const Matrix X = solveContinuousRiccati<kMpcStateDim>(A - B * R_inverse_Nt, B * R_inverse_Bt,
                                                        Qz - N * R_inverse_Nt);
  out.K = R_inverse_Bt * X + R_inverse_Nt;
  return out;
}

StateJacobian stateWeightOfTasks(const RobotParameters& robot, const Constraints& constraints,
                                 Tasks tasks, const ArmVector& arm) {
  const ReducedDynamics dynamics(robot);
  const StateVector x = findEquilibrium(dynamics, arm).x;
  const ReducedDynamics::EndEffector ee = dynamics.endEffector(x);
  tasks.p_WE = ee.p_WE;
  tasks.R_WE = ee.R_WE;
  tasks.v_WE_W = tasks.w_WE_W = Vector3::Zero();
  tasks.ball_position = tasks.ball_velocity = Eigen::Vector2d::Zero();
  tasks.yaw = 0;
  tasks.arm_position = arm;

  constexpr int kStride = roundUpTo4(kStateDim + 1);
  alignas(32) double expansion[kStride * kStride] = {};  // [Q q; q^T *], lower triangle
  CostTerms terms;
  WholeBodyCost(robot, constraints)
      .expandState(x, tasks, 1, terms, {expansion, kStride, kStateDim});
  const StateJacobian lower = Eigen::Map<const Eigen::Matrix<double, kStride, kStride>>(expansion)
                                  .topLeftCorner<kStateDim, kStateDim>();
  return lower.selfadjointView<Eigen::Lower>();
}

}  // namespace ballbot
