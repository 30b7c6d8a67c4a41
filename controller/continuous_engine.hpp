#pragma once

#include <memory>
#include <vector>

#include "controller/mpc_engine.hpp"
#include "controller/plan_problem.hpp"
#include "solver/continuous_slq.hpp"

namespace ballbot {

/// SLQ in continuous time, as the paper has it (ContinuousSlq, ContinuousProblem): slower than the
/// discrete engine, and its oracle.
template <int NU>
class ContinuousEngine final : public MpcEngine {
 public:
  ContinuousEngine(const RobotParameters& robot, const Constraints& constraints,
                   const FrequencyShaping& shaping, const TerminalCost& terminal,
                   const std::vector<double>& knots, std::shared_ptr<const TaskSchedule> schedule,
                   const SlqOptions& options, const ContinuousOptions& continuous = {});

  MpcPolicy emptyPolicy() const override;
  MpcSolveReport solve(SimTime now, const MpcState& x0, const MpcPolicy& guess, int iterations,
                       MpcPolicy& out) noexcept override;
  void setClock(PhaseClock clock) noexcept override { solver_.setClock(clock); }
  double shift() const noexcept override { return solver_.shift(); }
  void setShift(double shift) noexcept override { solver_.setShift(shift); }

 private:
  ContinuousPlanProblem<NU> problem_;
  ContinuousSlq<kMpcStateDim, NU, CostTerms> solver_;
};

}  // namespace ballbot
