#pragma once

#include <memory>

#include "model/reduced_dynamics.hpp"
#include "model/spinning_state.hpp"

namespace ballbot {

using SpinningMassMatrix = Eigen::Matrix<double, kSpinningVelocityDim, kSpinningVelocityDim>;
using SpinningSelectionMatrix = Eigen::Matrix<double, kJointCount, kSpinningVelocityDim>;

/// The robot of ReducedDynamics on a ball that rolls without slip but may spin about the vertical,
/// w_WK_W = (-vy/r, vx/r, spin):
///
///   M(q) dnu/dt + h(q, nu) = S(q)^T tau + J_E(q)^T (lambda_W, moment_W) + e_spin floor_torque
///
/// with nu = (nu of ReducedDynamics, spin). M gains the ball's inertia and what spinning it turns
/// the wheels; S^T tau gains the torque of the wheels on the ball about the vertical, which the
/// base has to bear anyhow; floor_torque is that of the floor on the ball about the vertical [N m].
/// ReducedDynamics is this with spin = 0 and whatever floorSpinTorque() takes to keep it there. The
/// end-effector knows nothing of the spin.
/// Const and free of allocation: may run in the control step.
class SpinningDynamics {
 public:
  explicit SpinningDynamics(const RobotParameters& robot);

  SpinningMassMatrix massMatrix(const PositionVector& q) const;
  /// Gravity, Coriolis and centrifugal terms [N, N m].
  SpinningVelocityVector nonlinearEffects(const PositionVector& q,
                                          const SpinningVelocityVector& nu) const;
  /// Joint rates = S(q) nu: a spin of 1 rad/s turns the wheels by -(r/r_w) D R_WB^T z.
  SpinningSelectionMatrix selectionMatrix(const PositionVector& q) const;

  /// dnu/dt for given torques and end-effector force.
  SpinningVelocityVector acceleration(const PositionVector& q, const SpinningVelocityVector& nu,
                                      const JointVector& tau, const Vector3& lambda_W,
                                      double floor_torque) const;
  /// dx/dt, x = (q, nu, spin).
  SpinningStateVector derivative(const SpinningStateVector& x, const JointVector& tau,
                                 const Vector3& lambda_W, double floor_torque,
                                 const Vector3* moment_W = nullptr) const;

  /// dx/dt with its partial derivatives; entries that are the same at every state are set by the
  /// constructor.
  struct Linearization {
    Linearization();
    template <int kColumns>
    using Jacobian = Eigen::Matrix<double, kSpinningStateDim, kColumns>;
    SpinningStateVector f = SpinningStateVector::Zero();
    Jacobian<kSpinningStateDim> df_dx = Jacobian<kSpinningStateDim>::Zero();
    Jacobian<kJointCount> df_dtau = Jacobian<kJointCount>::Zero();
    Jacobian<3> df_dlambda = Jacobian<3>::Zero();
    Jacobian<3> df_dmoment = Jacobian<3>::Zero();  ///< written where a moment is given
    Jacobian<1> df_dfloor = Jacobian<1>::Zero();   ///< by the floor's torque
  };
  void linearize(const SpinningStateVector& x, const JointVector& tau, const Vector3& lambda_W,
                 double floor_torque, Linearization& out, const Vector3* moment_W = nullptr) const;

  /// Torque of the floor on the ball about the vertical that keeps a ball which does not spin from
  /// spinning [N m]: the spin's row of the equations of motion at spin = 0,
  ///
  ///   (M dnu + h - S^T tau)_spin = -c . (tau_w - I_w (D dw + ddphi)),   c = -(r/r_w) D R_WB^T z,
  ///
  /// what the wheels' torques tau_w turn the ball with, less what only speeds up the wheels: D dw +
  /// ddphi are the angular accelerations of the wheels in W. The first part alone is SpinTorque
  /// (controller/).
  /// @param dnu  acceleration at which the robot moves, measured or planned
  double floorSpinTorque(const StateVector& x, const VelocityVector& dnu,
                         const JointVector& tau) const;
  /// The same at the acceleration that the torques give while the floor holds.
  double floorSpinTorque(const StateVector& x, const JointVector& tau, const Vector3& lambda_W,
                         const Vector3* moment_W = nullptr) const;

  /// Kinetic plus potential energy [J], zero potential at z = 0.
  double energy(const SpinningStateVector& x) const;

 private:
  ReducedDynamics held_;  ///< the same robot, its ball held
  std::shared_ptr<const DynamicsConstants> constants_;
};

}  // namespace ballbot
