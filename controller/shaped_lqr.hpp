#pragma once

#include "controller/constraints.hpp"
#include "controller/tasks.hpp"
#include "controller/whole_body_cost.hpp"
#include "model/reduced_dynamics.hpp"
#include "solver/frequency_shaping.hpp"

namespace ballbot {

/// The linear law that the whole-body MPC becomes about an equilibrium when its horizon grows
/// without end: tau = tau_eq - K (x - x_eq, x_f), x_f the filter states of the wheels' shaping.
struct ShapedLqr {
  Equilibrium equilibrium;
  ReducedDynamics::Linearization model;  ///< df_dx, df_dtau at the equilibrium
  FrequencyShaping shaping;
  Eigen::Matrix<double, kJointCount, kMpcStateDim> K;
};

/// Minimises 1/2 (dx^T Q dx + sum_i R_i (r(s) tau_i)^2), the wheels' r by `shaping` and the arm's 1
/// (Minniti et al. 2019, section III-C): an algebraic Riccati equation of 19 states with a cross
/// term.
/// @param arm  joint angles of the equilibrium [rad]
/// @param torque_weight  diagonal of R; more than 0
/// @throw NumericalError if there is no equilibrium, or Q does not see the ball's way.
ShapedLqr designShapedLqr(const ReducedDynamics& dynamics, const ArmVector& arm,
                          const StateJacobian& Q, const JointVector& torque_weight,
                          const FrequencyShaping& shaping);

/// Second derivative of the MPC's state cost rate at the equilibrium of the arm pose, references
/// moved there: the Q of designShapedLqr.
StateJacobian stateWeightOfTasks(const RobotParameters& robot, const Constraints& constraints,
                                 Tasks tasks, const ArmVector& arm);

}  // namespace ballbot
