#pragma once

#include <memory>
#include <vector>

#include "solver/feedback_trajectory.hpp"
#include "solver/optimal_control_problem.hpp"
#include "solver/slq_report.hpp"
#include "solver/stage_helper.hpp"

// Definitions are in slq_solver_impl.hpp, for whoever instantiates sizes of their own.

namespace ballbot {

/// Sequential linear-quadratic optimal control (Farshidian et al.; Minniti et al. 2019, section
/// III), discrete and single-shooting: roll the nominal policy out from the new state, approximate
/// dynamics and cost along it, one Riccati sweep, line search with the new feedback in the loop.
/// Only the constructor allocates. Equal problems, nominals and options give equal bits, with one
/// thread and with two.
template <int NX, int NU, typename Cost>
class SlqSolver {
 public:
  using Problem = OptimalControlProblem<NX, NU, Cost>;
  using X = typename Problem::X;
  using U = typename Problem::U;
  using Report = SlqReport<Cost>;
  using Trajectory = FeedbackTrajectory<NX, NU>;

  /// @param stages  of every problem it will be given
  SlqSolver(int stages, const SlqOptions& options);
  SlqSolver(const SlqSolver&) = delete;  // the helper knows where it is
  SlqSolver& operator=(const SlqSolver&) = delete;

  /// The policy an iteration starts from: set it before, e.g. from the previous solution.
  Trajectory& nominal() { return nominal_; }
  /// The policy it ended with; unchanged where the report is not ok().
  const Trajectory& solution() const { return solution_; }

  /// One iteration from x0. The nominal is overwritten by its rollout.
  Report iterate(const Problem& problem, const X& x0) noexcept;

  /// Iterates until the predicted decrease falls below `tolerance` of the cost, or `limit` times.
  /// Returns the report of the last accepted iteration, or of the last one if none was; `costs`, if
  /// given, receives the cost after each accepted iteration (and allocates for it).
  Report converge(const Problem& problem, const X& x0, int limit, double tolerance,
                  std::vector<double>* costs = nullptr);

  /// Regularisation of the next iteration: raised after failures, lowered after successes.
  double shift() const { return shift_; }
  void setShift(double shift) { shift_ = shift; }
  void setClock(PhaseClock clock) { options_.clock = clock; }

 private:
  /// False where the rollout, or the cost along it, is not finite.
  bool rollOutNominal(const Problem& problem, const X& x0) noexcept;
  bool approximate(const Problem& problem, const X& x0, Cost& cost) noexcept;
  void approximateStages(const Problem& problem, int first, int count) noexcept;
  /// False where H_u is not positive definite.
  bool sweep(double& predicted_decrease) noexcept;
  Cost tryStep(const Problem& problem, double alpha) noexcept;

  SlqOptions options_;
  double shift_;
  Trajectory nominal_, solution_, candidate_;
  std::vector<LqStage<NX, NU>> lq_;
  std::vector<Cost> stage_costs_;
  ValueFunction<NX> final_value_;
  const Problem* shared_problem_ = nullptr;  ///< what the helper works on
  std::unique_ptr<StageHelper> helper_;      ///< null with one thread
};

}  // namespace ballbot
