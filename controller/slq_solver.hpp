#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "controller/optimal_control_problem.hpp"
#include "controller/phase_clock.hpp"

namespace ballbot {

struct SlqOptions {
  int threads = 1;           ///< 1, or 2: a helper shares the approximation
  double base_shift = 1e-6;  ///< added to the diagonal of H_u
  double largest_shift = 1e6;
  double armijo = 1e-4;
  int line_search_steps = 4;  ///< 1, 1/2, 1/4, ...
  PhaseClock clock = nullptr;
};

enum class SlqStatus {
  kImproved,     ///< a step was accepted
  kConverged,    ///< nothing left to gain: the predicted decrease is below rounding
  kNoDescent,    ///< no step length lowered the cost
  kNotFinite,    ///< the nominal rollout diverged
  kNotConvex,    ///< H_u not positive definite even at the largest shift
};
const char* slqStatusName(SlqStatus status);

/// What one iteration did.
struct SlqReport {
  SlqStatus status = SlqStatus::kConverged;
  int iterations = 1;
  double nominal_cost = 0;        ///< of the nominal policy from the new initial state
  double cost = 0;                ///< of the result
  double predicted_decrease = 0;  ///< by the quadratic model, for a full step
  double step_length = 0;
  double shift = 0;               ///< Riccati regularisation used
  CostTerms terms;                ///< of the result
  PhaseTimes times;

  bool ok() const { return status == SlqStatus::kImproved || status == SlqStatus::kConverged; }
};

/// Trajectory with feedback: u = u_k + K_k (x - x_k). k() of the gains is not part of it.
template <int NX, int NU>
struct FeedbackTrajectory {
  std::vector<Eigen::Matrix<double, NX, 1>> x;  ///< N + 1
  std::vector<Eigen::Matrix<double, NU, 1>> u;  ///< N
  std::vector<StageGain<NX, NU>> gain;          ///< N

  void resize(int stages) {
    x.resize(stages + 1);
    u.resize(stages);
    gain.resize(stages);
  }
};

/// Sequential linear-quadratic optimal control (Farshidian et al.; Minniti et al. 2019, section
/// III), discrete and single-shooting: roll the nominal policy out from the new state, approximate
/// dynamics and cost along it, one Riccati sweep, line search with the new feedback in the loop.
/// Only the constructor allocates.
template <int NX, int NU>
class SlqSolver {
 public:
  using Problem = OptimalControlProblem<NX, NU>;
  using X = typename Problem::X;
  using U = typename Problem::U;
  using Trajectory = FeedbackTrajectory<NX, NU>;

  SlqSolver(int stages, const SlqOptions& options);
  ~SlqSolver();

  /// The policy an iteration starts from: set it before, e.g. from the previous solution.
  Trajectory& nominal() { return nominal_; }
  /// The policy it ended with; unchanged where the report is not ok().
  const Trajectory& solution() const { return solution_; }

  /// One iteration from x0. The nominal is overwritten by its rollout.
  SlqReport iterate(const Problem& problem, const X& x0) noexcept;

  /// Iterates until the predicted decrease falls below `tolerance` of the cost, or `limit` times.
  /// Returns the report of the last accepted iteration, or of the last one if none was; `costs`, if
  /// given, receives the cost after each accepted iteration (and allocates for it).
  SlqReport converge(const Problem& problem, const X& x0, int limit, double tolerance,
                     std::vector<double>* costs = nullptr);

  /// Regularisation of the next iteration: raised after failures, lowered after successes.
  double shift() const { return shift_; }
  void setShift(double shift) { shift_ = shift; }
  void setClock(PhaseClock clock) { options_.clock = clock; }

 private:
  class Helper;

  /// False where the rollout, or the cost along it, is not finite.
  bool rollOutNominal(const Problem& problem, const X& x0) noexcept;
  bool approximate(const Problem& problem, const X& x0, CostTerms& terms) noexcept;
  void approximateStages(const Problem& problem, int first, int count) noexcept;
  /// False where H_u is not positive definite.
  bool sweep(double& predicted_decrease) noexcept;
  CostTerms tryStep(const Problem& problem, double alpha) noexcept;

  SlqOptions options_;
  double shift_;
  Trajectory nominal_, solution_, candidate_;
  std::vector<LqStage<NX, NU>> lq_;
  std::vector<CostTerms> stage_terms_;
  ValueFunction<NX> final_value_;
  std::unique_ptr<Helper> helper_;
};

}  // namespace ballbot
