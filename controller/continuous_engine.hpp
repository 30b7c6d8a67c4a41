#pragma once

#include <memory>
#include <vector>

#include "controller/disturbed_problem.hpp"
#include "controller/floor_limited_problem.hpp"
#include "controller/mpc_engine.hpp"
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
  void setFloorHeld(double torque) noexcept override { floor_limited_.setHeld(torque); }
  void setLoad(const LastingLoad& load) noexcept override { disturbed_.setLoad(load); }
  void setPayload(double mass) noexcept override { problem_.setPayload(mass); }
  void setClock(PhaseClock clock) noexcept override { solver_.setClock(clock); }
  double shift() const noexcept override { return solver_.shift(); }
  void setShift(double shift) noexcept override { solver_.setShift(shift); }

 private:
  ContinuousProblem<NU> problem_;
  FloorLimitedContinuousProblem<NU> floor_limited_;
  DisturbedContinuousProblem<NU> disturbed_;  ///< either, under a lasting force
  ContinuousSlq<kMpcStateDim, NU, CostTerms> solver_;
};

}  // namespace ballbot
