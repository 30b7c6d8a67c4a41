#pragma once

#include <vector>

#include "controller/whole_body_cost.hpp"
#include "solver/frequency_shaping.hpp"
#include "solver/optimal_control_problem.hpp"

namespace ballbot {

/// The whole-body problem on a grid of knots: state (q, nu, x_f); input tau (NU = 6), with contact
/// forces (NU = 9), with forces and moments (NU = 12); inputs are held over a step.
///
/// One step of length H: positions drift half a step, velocities get the acceleration found there,
/// positions drift with the mean velocity. Second order but for the Coriolis terms, which see the
/// velocity at the start; one dynamics evaluation a step. The filter is exact (FilterStep).
///
///   q_m = q + H/2 T(q) nu,   nu+ = nu + H a(q_m, nu, u),   q+ = q + H T(q_m) (nu + nu+)/2
///
/// The state's cost is integrated by the trapezoidal rule, the input's exactly.
template <int NU>
class WholeBodyProblem final : public OptimalControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = OptimalControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Stage = LqStage<kMpcStateDim, NU>;

  WholeBodyProblem(const RobotParameters& robot, const Constraints& constraints,
                   const FrequencyShaping& shaping, const TerminalCost& terminal,
                   const std::vector<double>& knots);

  /// Tasks for a horizon that starts at t0 [s]. Free of allocation.
  void setTasks(const TaskSchedule& schedule, double t0, const ContactSituation& contact = {},
                const GovernedCommands& commands = {}) noexcept;
  /// Another mass in the hand, from now on [kg]. Free of allocation.
  void setPayload(double mass) noexcept { dynamics_.setPayload(mass); }
  /// For tests and special uses: the tasks of one knot.
  Tasks& tasks(int k) { return tasks_[k]; }

  int stages() const noexcept override { return static_cast<int>(steps_.size()); }
  void step(int k, const X& x, const U& u, X& next) const noexcept override;
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override;
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;
  void approximateFinalCost(const X& x, CostTerms& terms,
                            ValueFunction<kMpcStateDim>& value) const noexcept override;

 private:
  /// Four stages, or what is left of them, together: the dynamics take little longer for them than
  /// for one.
  static constexpr int kTogether = 4;
  void linearize(int first, int count, const X* x, const U* u, Stage* lq) const noexcept;
  void linearizeStage(int k, const X& x, const PositionVector& q_mid,
                      const ReducedDynamics::Linearization& model, Stage& lq) const noexcept;
  void approximateCost(int k, const X& x, const U& u,
                       const ReducedDynamics::EndEffectorLinearization& tip, CostTerms& terms,
                       Stage& lq) const noexcept;

  ReducedDynamics dynamics_;
  WholeBodyCost cost_;
  std::vector<FilterStep> steps_;    ///< one per stage; H is the stage's length
  std::vector<double> state_share_;  ///< trapezoidal weight of each knot's state cost [s]
  std::vector<Tasks> tasks_;         ///< one per knot
};

}  // namespace ballbot
