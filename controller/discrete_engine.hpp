#pragma once

#include <memory>
#include <vector>

#include "controller/mpc_engine.hpp"
#include "controller/plan_problem.hpp"
#include "solver/real_time_iteration.hpp"

namespace ballbot {

/// SLQ on a fixed or graded grid of knots (RealTimeIteration, WholeBodyProblem): the fast default.
/// NU = 9 plans contact forces; NU = 6 leaves them out.
template <int NU>
class DiscreteEngine final : public MpcEngine {
 public:
  DiscreteEngine(const RobotParameters& robot, const Constraints& constraints,
                 const FrequencyShaping& shaping, const TerminalCost& terminal,
                 const std::vector<double>& knots, std::shared_ptr<const TaskSchedule> schedule,
                 const SlqOptions& options);

  MpcPolicy emptyPolicy() const override;
  MpcSolveReport solve(SimTime now, const MpcState& x0, const MpcPolicy& guess, int iterations,
                       MpcPolicy& out) noexcept override;
  void setClock(PhaseClock clock) noexcept override { solver_.setClock(clock); }
  double shift() const noexcept override { return solver_.shift(); }
  void setShift(double shift) noexcept override { solver_.setShift(shift); }

 private:
  PlanProblem<NU> problem_;
  RealTimeIteration<kMpcStateDim, NU, CostTerms> solver_;
};

}  // namespace ballbot
