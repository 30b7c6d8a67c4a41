#pragma once

#include <vector>

#include "solver/slq_solver.hpp"
#include "solver/stage_check.hpp"

namespace ballbot {

/// Solves a problem again and again while time passes (the real-time iteration of Diehl et al.): a
/// solve begins from the last plan and takes one iteration, or a few. The guess is read by time: no
/// index is shifted, so any period and any grid will do.
template <int NX, int NU, typename Cost>
class RealTimeIteration {
 public:
  using Solver = SlqSolver<NX, NU, Cost>;
  using Problem = typename Solver::Problem;
  using X = typename Problem::X;
  using U = typename Problem::U;

  /// @param knots  from the horizon's start, one more than the problem has stages, rising [s]
  RealTimeIteration(const std::vector<double>& knots, const SlqOptions& options)
      : knots_(knots), solver_(static_cast<int>(knots.size()) - 1, options) {
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      control_times_.push_back(0.5 * (knots[k] + knots[k + 1]));
    }
  }

  /// The same, for a problem that has to fit. @throw InputError with both numbers of stages.
  RealTimeIteration(const std::vector<double>& knots, const Problem& problem,
                    const SlqOptions& options)
      : RealTimeIteration(knots, options) {
    requireFits(solver_, problem);
  }

  const std::vector<double>& knots() const noexcept { return knots_; }
  /// Middles of the steps: to what times inputs and gains belong.
  const std::vector<double>& controlTimes() const noexcept { return control_times_; }

  /// Improves `guess`. Free of allocation.
  /// @param x0     state at the horizon's start
  /// @param guess  read by X stateAt(t) and controlAt(t, U& u, K), which writes into the view K of
  /// an
  ///               NU x NX matrix; as a SampledPolicy has them, both const
  /// @param age    what t is to the guess at the horizon's start [s]
  /// @param iterations  at most
  template <typename Guess>
  SlqReport<Cost> solve(const Problem& problem, const X& x0, const Guess& guess, double age,
                        int iterations) noexcept {
    auto& nominal = solver_.nominal();
    for (std::size_t k = 0; k < control_times_.size(); ++k) {
      nominal.x[k] = guess.stateAt(age + knots_[k]);
      guess.controlAt(age + control_times_[k], nominal.u[k], nominal.gain[k].K());
    }
    return iterations == 1 ? solver_.iterate(problem, x0)
                           : solver_.converge(problem, x0, iterations, kTolerance);
  }

  /// Of the last solve whose report was ok().
  const FeedbackTrajectory<NX, NU>& solution() const noexcept { return solver_.solution(); }

  double shift() const noexcept { return solver_.shift(); }
  void setShift(double shift) noexcept { solver_.setShift(shift); }
  void setClock(PhaseClock clock) noexcept { solver_.setClock(clock); }

 private:
  static constexpr double kTolerance = 1e-9;

  std::vector<double> knots_, control_times_;
  Solver solver_;
};

}  // namespace ballbot
