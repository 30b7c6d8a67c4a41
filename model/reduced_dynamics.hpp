#pragma once

#include <memory>

#include "model/robot_parameters.hpp"
#include "model/state.hpp"

namespace ballbot {

struct DynamicsConstants;

using MassMatrix = Eigen::Matrix<double, kVelocityDim, kVelocityDim>;
using SelectionMatrix = Eigen::Matrix<double, kJointCount, kVelocityDim>;
using EndEffectorJacobian = Eigen::Matrix<double, 6, kVelocityDim>;
using StateJacobian = Eigen::Matrix<double, kStateDim, kStateDim>;
using TorqueJacobian = Eigen::Matrix<double, kStateDim, kJointCount>;
using ForceJacobian = Eigen::Matrix<double, kStateDim, 3>;

/// The robot's 8 degrees of freedom as rigid bodies on a ball that rolls without slip and without
/// spin about the vertical:
///
///   M(q) dnu/dt + h(q, nu) = S(q)^T tau + J_E(q)^T (lambda_W, moment_W)
///
/// tau: actuator torques, wheels then arm [N m]; lambda_W and moment_W: force and, where there is
/// one, moment of the environment on the end-effector, at E, in W [N, N m]. From a Newton-Euler
/// pass (Minniti et al. 2019, eq. 1-3).
/// Const and free of allocation: may run in the control step.
class ReducedDynamics {
 public:
  explicit ReducedDynamics(const RobotParameters& robot);
  const RobotParameters& robot() const { return robot_; }

  /// Another mass in the hand from now on [kg], for this and for copies that were made of it. Not
  /// of a robot with a rigid arm, and not while another thread computes with it. Free of
  /// allocation.
  void setPayload(double mass) noexcept;

  MassMatrix massMatrix(const PositionVector& q) const;
  /// Gravity, Coriolis and centrifugal terms [N, N m].
  VelocityVector nonlinearEffects(const PositionVector& q, const VelocityVector& nu) const;
  /// Joint rates = S(q) nu: rolling rows for the wheels, identity for the arm.
  SelectionMatrix selectionMatrix(const PositionVector& q) const;

  /// dnu/dt for given torques and end-effector force.
  VelocityVector acceleration(const PositionVector& q, const VelocityVector& nu,
                              const JointVector& tau, const Vector3& lambda_W) const;
  /// dx/dt, x = (q, nu).
  StateVector derivative(const StateVector& x, const JointVector& tau, const Vector3& lambda_W,
                         const Vector3* moment_W = nullptr) const;

  /// dx/dt with its partial derivatives. The constructor sets the entries that are the same at
  /// every state: zeros, and the ones of dq/dnu. They are never written again.
  struct Linearization {
    Linearization();
    StateVector f = StateVector::Zero();
    StateJacobian df_dx = StateJacobian::Zero();
    TorqueJacobian df_dtau = TorqueJacobian::Zero();
    ForceJacobian df_dlambda = ForceJacobian::Zero();
    ForceJacobian df_dmoment = ForceJacobian::Zero();  ///< written where a moment is given
  };
  void linearize(const StateVector& x, const JointVector& tau, const Vector3& lambda_W,
                 Linearization& out, const Vector3* moment_W = nullptr) const;

  struct EndEffector {
    Vector3 p_WE;    ///< position in W [m]
    Matrix3 R_WE;    ///< orientation
    Vector3 v_WE_W;  ///< velocity [m/s]
    Vector3 w_WE_W;  ///< angular velocity, in W [rad/s]
  };
  EndEffector endEffector(const StateVector& x) const;
  /// (v_WE_W; w_WE_W) = J nu.
  EndEffectorJacobian endEffectorJacobian(const PositionVector& q) const;

  /// Pose and twist of the end-effector with their derivatives. Rows: displacement of E, then small
  /// rotation of E about axes of W; of the twist: v_WE_W, then w_WE_W. Constant entries are those
  /// of the constructor, as above.
  struct EndEffectorLinearization {
    EndEffectorLinearization();
    EndEffector value;
    EndEffectorJacobian jacobian = EndEffectorJacobian::Zero();  ///< of the twist by nu, and so of
                                                                 ///< the pose by nu dt
    EndEffectorJacobian dpose_dq = EndEffectorJacobian::Zero();  ///< by (px, py, yaw, pitch, ...)
    EndEffectorJacobian dtwist_dq = EndEffectorJacobian::Zero();
  };
  void linearizeEndEffector(const StateVector& x, EndEffectorLinearization& out) const;

  /// The same for `count` states: arrays in, arrays out. Four states at once take little longer
  /// than one, and each gets the same bits as it would alone.
  /// @param moment_W  null where there are none
  void derivatives(int count, const StateVector* x, const JointVector* tau, const Vector3* lambda_W,
                   StateVector* dx, const Vector3* moment_W = nullptr) const;
  /// @param end_effector  null where it is not wanted
  void linearize(int count, const StateVector* x, const JointVector* tau, const Vector3* lambda_W,
                 Linearization* out, EndEffectorLinearization* end_effector,
                 const Vector3* moment_W = nullptr) const;
  void linearizeEndEffector(int count, const StateVector* x, EndEffectorLinearization* out) const;

  /// Kinetic plus potential energy [J], zero potential at z = 0.
  double energy(const StateVector& x) const;
  /// The potential part of it [J].
  double potentialEnergy(const PositionVector& q) const;

 private:
  RobotParameters robot_;
  std::shared_ptr<DynamicsConstants> constants_;
};

/// Pitch and roll at which the robot stands still with the arm at `arm` and no force on it, and
/// the torques that hold it there. Returned as a state with px = py = yaw = 0.
/// @throw NumericalError if there is none within 30 degrees.
struct Equilibrium {
  StateVector x;
  JointVector tau;
};
Equilibrium findEquilibrium(const ReducedDynamics& dynamics, const ArmVector& arm);

}  // namespace ballbot
