#pragma once

#include "controller/frequency_shaping.hpp"
#include "controller/optimal_control_problem.hpp"
#include "controller/whole_body_problem.hpp"

namespace ballbot {

/// The whole-body problem in continuous time: dx/dt = f(x, u) of (q, nu, x_f) and the cost rate
/// L(x, u), with their expansions. Same tasks, constraints and shaping as WholeBodyProblem.
template <int NU>
class ContinuousProblem {
 public:
  using X = Eigen::Matrix<double, kMpcStateDim, 1>;
  using U = Eigen::Matrix<double, NU, 1>;
  using Expansion = LqStage<kMpcStateDim, NU>;  ///< A, B: derivatives of f; costs: of the rate L

  ContinuousProblem(const RobotParameters& robot, const Constraints& constraints,
                    const FrequencyShaping& shaping, const TerminalCost& terminal);

  void flow(const X& x, const U& u, const Tasks& tasks, X& dx) const noexcept;
  /// Adds L.
  void addCostRate(const X& x, const U& u, const Tasks& tasks, CostTerms& terms) const noexcept;
  void expand(const X& x, const U& u, const Tasks& tasks, X& dx, Expansion& out) const noexcept;

  void addFinalCost(const X& x, const Tasks& tasks, CostTerms& terms) const noexcept;
  void expandFinalCost(const X& x, const Tasks& tasks,
                       ValueFunction<kMpcStateDim>& value) const noexcept;

 private:
  ReducedDynamics dynamics_;
  WholeBodyCost cost_;
  FrequencyShaping shaping_;
};

}  // namespace ballbot
