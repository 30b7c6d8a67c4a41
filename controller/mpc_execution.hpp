#pragma once

#include "controller/mpc_planner.hpp"

namespace ballbot {

/// What acts between two plans, whoever solves them: the plan in force while it is young enough,
/// and else an LQR that holds the robot where the last good plan left it; the state of the shaping
/// filter, driven by what is commanded.
class MpcExecution {
 public:
  MpcExecution(const RobotParameters& robot, const MpcConfig& config);

  bool inForce(const MpcPolicy& active, SimTime now) const noexcept;
  /// The LQR stands in for lack of a plan: the last one is too old, or there never was one and the
  /// solver has `refused` already.
  bool fellBack(const MpcPolicy& active, bool refused, SimTime now) const noexcept;

  /// Plans the LQR beside the MPC. As long as plans are good its set-point follows the robot; then
  /// it stays, so that the LQR holds the place.
  /// @return what the LQR would do now, from which a solve may start
  PolicySample planStandIn(const MpcPolicy& active, bool refused, SimTime now, const StateVector& x,
                           const JointVector& joint_angle) noexcept;
  void activateStandIn() noexcept { lqr_.activatePlan(); }

  void sample(const MpcPolicy& active, SimTime now, PolicySample& out) const noexcept;
  void commanded(SimDuration period, const JointVector& torque) noexcept;
  const Vector3& filterState() const noexcept { return xf_; }  ///< [N m]

  void setCircumstances(const Circumstances& now) noexcept { lqr_.setCircumstances(now); }

  StateBlob saveStandIn() const { return lqr_.saveState(); }
  void restore(const Vector3& filter_state, const StateBlob& stand_in);

 private:
  SimDuration fallback_after_;
  FrequencyShaping shaping_;
  LqrLaw lqr_;
  Vector3 xf_ = Vector3::Zero();
};

}  // namespace ballbot
