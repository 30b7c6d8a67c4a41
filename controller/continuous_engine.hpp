#pragma once

#include <memory>
#include <vector>

#include "controller/continuous_problem.hpp"
#include "controller/erk_integrator.hpp"
#include "controller/mpc_engine.hpp"

namespace ballbot {

struct ContinuousOptions {
  double tolerance = 1e-5;  ///< relative, of rollout and Riccati equations per step
};

/// SLQ in continuous time, as the paper has it: rollout and Riccati differential equations under
/// error control. The problem is expanded at the knots and interpolated between them; input, gain
/// and step are linear between knots, the nominal state is the cubic through values and rates.
///
///   -dS/dt = Q + A^T S + S A - G^T R^-1 G,  -ds/dt = q + A^T s - G^T R^-1 g,
///   G = P + B^T S,  g = r + B^T s,  K = -R^-1 G,  du = -R^-1 g
///
/// Slower than the discrete engine and independent of it in everything but model and cost: its
/// oracle.
template <int NU>
class ContinuousEngine final : public MpcEngine {
 public:
  ContinuousEngine(const RobotParameters& robot, const Constraints& constraints,
                   const FrequencyShaping& shaping, const TerminalCost& terminal,
                   const std::vector<double>& knots, std::shared_ptr<const TaskSchedule> schedule,
                   const SlqOptions& options, const ContinuousOptions& continuous = {});

  MpcPolicy emptyPolicy() const override;
  SlqReport solve(SimTime now, const MpcState& x0, const MpcPolicy& guess, int iterations,
                  MpcPolicy& out) noexcept override;
  void setClock(PhaseClock clock) noexcept override { options_.clock = clock; }
  double shift() const noexcept override { return shift_; }
  void setShift(double shift) noexcept override { shift_ = shift; }

 private:
  using Problem = ContinuousProblem<NU>;
  using X = typename Problem::X;
  using U = typename Problem::U;
  using Gain = Eigen::Matrix<double, NU, kMpcStateDim>;

  struct Node {
    X x, dx;  ///< state and its rate on the side of the interval that follows
    U u;
    Gain K;
    U step;  ///< du of a full step
  };
  struct RolloutFlow;
  struct RiccatiFlow;

  SlqReport iterate(const X& x0) noexcept;
  /// Rolls nodes_ out with the step scaled by alpha, into rolled_. False where it diverged.
  bool rollout(const X& x0, double alpha, CostTerms& terms) noexcept;
  /// The nominal through the rolled-out states with the inputs they got.
  void adoptRollout() noexcept;
  void expand() noexcept;
  bool sweep(double& predicted_decrease) noexcept;
  void tasksAt(double t) noexcept;  ///< since t0_ [s], into tasks_
  U inputAt(double t, const X& x, double alpha) const noexcept;
  X nominalAt(double t) const noexcept;

  std::vector<double> knots_;
  std::shared_ptr<const TaskSchedule> schedule_;
  Problem problem_;
  SlqOptions options_;
  double tolerance_;
  double shift_;

  double t0_ = 0;             ///< absolute time of the first knot [s]
  int interval_ = 0;          ///< between which knots the integrators are
  double alpha_ = 0;
  Tasks tasks_;               ///< of the time the flow is at
  std::vector<Node> nodes_;
  std::vector<X> rolled_x_;
  std::vector<U> rolled_u_;
  std::vector<typename Problem::Expansion> expansions_;
  typename Problem::Expansion between_;
  ValueFunction<kMpcStateDim> final_value_;
  std::unique_ptr<ErkIntegrator> rollout_, riccati_;
};

}  // namespace ballbot
