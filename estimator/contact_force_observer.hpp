#pragma once

#include <optional>

#include "core/time.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// Estimates the force of the environment on the end-effector from the torques that the arm's
/// series elastic joints measure. There is no force sensor: what the arm's torques do not explain
/// of the change of generalised momentum p = M(q) nu must come from outside,
///
///   r = K (p - p0 - integral(S^T tau + dM/dt nu - h + r) dt),   dr/dt = K (J_E^T lambda - r),
///
/// so no acceleration is needed. lambda follows from the arm's three rows of r alone: what pushes
/// on ball or base does not appear in them.
class ContactForceObserver {
 public:
  /// @param robot      as the controller believes it, payload included
  /// @param bandwidth  K [rad/s]
  ContactForceObserver(const RobotParameters& robot, double bandwidth);

  /// Forgets everything; the next update starts from no force.
  void reset() noexcept {
    started_ = false;
    force_W_.setZero();
    residual_.setZero();
  }
  /// @param x       estimated state at `now`
  /// @param torque  measured on the joints at `now` [N m]
  void update(SimTime now, const StateVector& x, const JointVector& torque) noexcept;

  /// A mass in the hand that is counted on from now on [kg].
  void setPayload(double mass) noexcept {
    if (mass != dynamics_.robot().payload_mass) dynamics_.setPayload(mass);
  }

  /// On the end-effector, in W [N]; zero before the second update.
  const Vector3& force() const noexcept { return force_W_; }

  /// r: what the model does not explain, in the rows of nu [N, N m]; zero before the second update.
  const VelocityVector& residual() const noexcept { return residual_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.time_);
    visit(self.explained_);
    visit(self.rate_);
    visit(self.residual_);
    visit(self.force_W_);
  }

 private:
  VelocityVector momentum(const PositionVector& q, const VelocityVector& nu) const;

  ReducedDynamics dynamics_;
  double bandwidth_;
  bool started_ = false;
  SimTime time_{};
  VelocityVector explained_ = VelocityVector::Zero();  ///< p0 + the integral
  VelocityVector rate_ = VelocityVector::Zero();       ///< integrand without r at the last update
  VelocityVector residual_ = VelocityVector::Zero();   ///< r
  Vector3 force_W_ = Vector3::Zero();
};

}  // namespace ballbot
