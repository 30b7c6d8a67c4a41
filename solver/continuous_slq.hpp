#pragma once

#include <memory>
#include <vector>

#include "solver/continuous_control_problem.hpp"
#include "solver/erk_integrator.hpp"
#include "solver/feedback_trajectory.hpp"
#include "solver/slq_report.hpp"

// Definitions are in continuous_slq_impl.hpp, for whoever instantiates sizes of their own.

namespace ballbot {

struct ContinuousOptions {
  double tolerance = 1e-5;  ///< relative, of rollout and Riccati equations per step
};

/// SLQ in continuous time, as Minniti et al. 2019 have it: rollout and Riccati differential
/// equations under error control. The problem is expanded at the knots and interpolated between
/// them; input, gain and step are linear between knots, the nominal state is the cubic through
/// values and rates.
///
///   -dS/dt = Q + A^T S + S A - G^T R^-1 G,  -ds/dt = q + A^T s - G^T R^-1 g,
///   G = P + B^T S,  g = r + B^T s,  K = -R^-1 G,  du = -R^-1 g
///
/// Slower than SlqSolver and independent of it in everything but model and cost: its oracle. Its
/// integrators allocate when they start.
template <int NX, int NU, typename Cost>
class ContinuousSlq {
 public:
  using Problem = ContinuousControlProblem<NX, NU, Cost>;
  using X = typename Problem::X;
  using U = typename Problem::U;
  using Gain = Eigen::Matrix<double, NU, NX>;
  using Report = SlqReport<Cost>;

  /// @param knots  from the horizon's start, rising [s]
  /// @param options  one thread, whatever they say
  /// @param state_size  absolute tolerance of each state relative to that of the cost, which is
  ///                    the relative one
  ContinuousSlq(const std::vector<double>& knots, const SlqOptions& options,
                const ContinuousOptions& continuous, const X& state_size = X::Ones());
  ContinuousSlq(const ContinuousSlq&) = delete;  // the integrators know where it is
  ContinuousSlq& operator=(const ContinuousSlq&) = delete;

  const std::vector<double>& knots() const noexcept { return knots_; }

  /// Improves `guess`, which is read by time as RealTimeIteration does.
  template <typename Guess>
  Report solve(Problem& problem, const X& x0, const Guess& guess, double age,
               int iterations) noexcept {
    problem_ = &problem;
    for (std::size_t k = 0; k < knots_.size(); ++k) {
      Node& node = nodes_[k];
      guess.controlAt(age + knots_[k], node.u, node.K);
      node.x = guess.stateAt(age + knots_[k]);
      node.step.setZero();
      problem.setTime(knots_[k]);
      problem.flow(node.x, node.u, node.dx);
    }
    return iterate(x0, iterations);
  }

  /// Of the last solve whose report was ok(): states, inputs and gains, all of them at the knots.
  const FeedbackTrajectory<NX, NU>& solution() const noexcept { return solution_; }

  double shift() const noexcept { return shift_; }
  void setShift(double shift) noexcept { shift_ = shift; }
  void setClock(PhaseClock clock) noexcept { options_.clock = clock; }

 private:
  static constexpr int kRolloutDim = NX + Cost::kCount;  ///< state, and integrals of cost terms
  using Value = ValueFunction<NX>;
  static constexpr int kRiccatiDim = Value::kX * Value::kX;  ///< augmented value [S s; s^T 2c]

  struct Node {
    X x, dx;  ///< state and its rate on the side of the interval that follows
    U u;
    Gain K;
    U step;  ///< du of a full step
  };
  struct RolloutFlow;
  struct RiccatiFlow;

  Report iterate(const X& x0, int limit) noexcept;
  Report iterate(const X& x0) noexcept;
  /// Rolls nodes_ out with the step scaled by alpha, into rolled_. False where it diverged.
  bool rollout(const X& x0, double alpha, Cost& cost) noexcept;
  /// The nominal through the rolled-out states with the inputs they got.
  void adoptRollout() noexcept;
  void expand() noexcept;
  bool sweep(double& predicted_decrease) noexcept;
  U inputAt(double t, const X& x, double alpha) const noexcept;
  X nominalAt(double t) const noexcept;

  std::vector<double> knots_;
  SlqOptions options_;
  double tolerance_;
  double shift_;
  Problem* problem_ = nullptr;  ///< of the solve that runs

  int interval_ = 0;  ///< between which knots the integrators are
  double alpha_ = 0;
  std::vector<Node> nodes_;
  std::vector<X> rolled_x_;
  std::vector<U> rolled_u_;
  std::vector<typename Problem::Expansion> expansions_;
  typename Problem::Expansion between_;
  Value final_value_;
  FeedbackTrajectory<NX, NU> solution_;
  std::unique_ptr<ErkIntegrator> rollout_, riccati_;
};

}  // namespace ballbot
