#pragma once

#include <memory>

#include "controller/whole_body_cost.hpp"
#include "solver/continuous_control_problem.hpp"
#include "solver/frequency_shaping.hpp"

namespace ballbot {

/// The whole-body problem in continuous time: dx/dt = f(x, u) of (q, nu, x_f) and the cost rate
/// L(x, u), with their expansions. Same tasks, constraints and shaping as WholeBodyProblem.
template <int NU>
class ContinuousProblem final : public ContinuousControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = ContinuousControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Expansion = typename Base::Expansion;

  ContinuousProblem(const RobotParameters& robot, const Constraints& constraints,
                    const FrequencyShaping& shaping, const TerminalCost& terminal,
                    std::shared_ptr<const TaskSchedule> schedule);

  /// For a horizon that starts at t0 [s].
  void setHorizon(double t0, const ContactSituation& contact,
                  const GovernedCommands& commands) noexcept;
  /// Another mass in the hand, from now on [kg]. Free of allocation.
  void setPayload(double mass) noexcept { dynamics_.setPayload(mass); }

  void setTime(double t) noexcept override;
  /// Those of the time that was set.
  Tasks& tasks() noexcept { return tasks_; }
  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override;
  void expandFinalCost(const X& x, ValueFunction<kMpcStateDim>& value) const noexcept override;

 private:
  ReducedDynamics dynamics_;
  WholeBodyCost cost_;
  FrequencyShaping shaping_;
  std::shared_ptr<const TaskSchedule> schedule_;
  double t0_ = 0;
  ContactSituation contact_;
  GovernedCommands commands_;
  Tasks tasks_;  ///< of the time that was set
};

}  // namespace ballbot
