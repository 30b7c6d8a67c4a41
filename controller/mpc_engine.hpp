#pragma once

#include "controller/mpc_policy.hpp"
#include "controller/plan_conditions.hpp"
#include "solver/slq_report.hpp"

namespace ballbot {

using MpcSolveReport = SlqReport<CostTerms>;

/// Solves the whole-body problem over the horizon: the discrete engine or the continuous-time one.
class MpcEngine {
 public:
  virtual ~MpcEngine() = default;

  /// A plan of this engine's size, to be filled by solve().
  virtual MpcPolicy emptyPolicy() const = 0;

  /// Improves `guess`, read at absolute times, from the state x0 at `now`.
  /// @param iterations  at most; 1 is the real-time iteration
  /// @param out  the plan, where the report is ok(); joint set-points are not filled. May not be
  ///             `guess`.
  virtual MpcSolveReport solve(SimTime now, const MpcState& x0, const MpcPolicy& guess,
                               int iterations, MpcPolicy& out) noexcept = 0;

  /// For the solves that follow.
  void setContact(const ContactSituation& contact) noexcept { contact_ = contact; }
  void setCommands(const GovernedCommands& commands) noexcept { commands_ = commands; }
  void setConditions(const PlanConditions& conditions) noexcept { conditions_ = conditions; }

  virtual void setClock(PhaseClock clock) noexcept = 0;

  /// What the engine carries from one solve to the next.
  virtual double shift() const noexcept = 0;
  virtual void setShift(double shift) noexcept = 0;

 protected:
  ContactSituation contact_;
  GovernedCommands commands_;
  PlanConditions conditions_;
};

}  // namespace ballbot
