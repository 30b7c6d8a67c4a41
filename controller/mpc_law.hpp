#pragma once

#include <cstdint>

#include "controller/mpc_execution.hpp"
#include "controller/mpc_planner.hpp"

namespace ballbot {

/// Whole-body MPC as a control law, solved where plan() is called: for runs in lockstep, where a
/// plan's latency is a matter of configuration. If no plan was good for `fallback_after`, or none
/// ever, the LQR holds the robot where it is until plans succeed again.
class MpcLaw final : public ControlLaw {
 public:
  MpcLaw(const RobotParameters& robot, const MpcConfig& config);

  PlanReport plan(SimTime now, const StateVector& x,
                  const JointVector& joint_angle) noexcept override;
  void setCircumstances(const Circumstances& now) noexcept override {
    planner_.setCircumstances(now);
    execution_.setCircumstances(now);
  }
  void setClock(PhaseClock clock) noexcept override { planner_.setClock(clock); }
  void activatePlan() noexcept override;
  void sample(SimTime now, PolicySample& out) const noexcept override;
  void commanded(SimTime now, SimDuration period, const JointVector& torque) noexcept override;

  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  const MpcPolicy& activePolicy() const { return active_; }
  std::int64_t failedPlans() const { return failed_plans_; }

 private:
  /// What is saved; engine and workspaces are not.
  struct State;
  State state() const;

  MpcExecution execution_;
  MpcPlanner planner_;
  MpcPolicy planned_, active_, scratch_;
  std::int64_t failed_plans_ = 0;
};

}  // namespace ballbot
