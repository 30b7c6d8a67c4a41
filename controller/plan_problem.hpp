#pragma once

#include <memory>
#include <vector>

#include "controller/disturbed_problem.hpp"
#include "controller/floor_limited_problem.hpp"
#include "controller/lost_wheel_problem.hpp"
#include "controller/plan_conditions.hpp"
#include "controller/pushed_problem.hpp"
#include "controller/traction_limited_problem.hpp"
#include "controller/whole_body_problem.hpp"

namespace ballbot {

/// The whole-body problem, and what is made of it by what a plan counts on: the floor's hold, a
/// lost wheel, a force that lasts, a push. Chooses the one to be solved. Compiled apart from the
/// solver, whose last bits would change with it.
template <int NU>
class PlanProblem {
 public:
  using Base = typename WholeBodyProblem<NU>::Base;

  PlanProblem(const RobotParameters& robot, const Constraints& constraints,
              const FrequencyShaping& shaping, const TerminalCost& terminal,
              const std::vector<double>& knots, std::shared_ptr<const TaskSchedule> schedule);

  int stages() const noexcept { return whole_body_.stages(); }

  /// That of a horizon which starts at t0 [s]; good until the next call. Free of allocation.
  const Base& at(double t0, const ContactSituation& contact, const GovernedCommands& commands,
                 const PlanConditions& conditions) noexcept;

 private:
  double payload_;  ///< of the models [kg]
  std::shared_ptr<const TaskSchedule> schedule_;
  WholeBodyProblem<NU> whole_body_;
  FloorLimitedProblem<NU> floor_limited_;  ///< the same on a floor that does not hold everything
  LostWheelProblem<NU> lost_wheel_;        ///< the same without a wheel, on any floor
  TractionLimitedProblem<NU> traction_;    ///< any of them, on wheels that may slip
  DisturbedProblem<NU> disturbed_;         ///< any of them, under a force that lasts
  PushedProblem<NU> pushed_;               ///< and any of these, pushed
};

/// The same in continuous time.
template <int NU>
class ContinuousPlanProblem {
 public:
  using Base = typename ContinuousProblem<NU>::Base;

  ContinuousPlanProblem(const RobotParameters& robot, const Constraints& constraints,
                        const FrequencyShaping& shaping, const TerminalCost& terminal,
                        std::shared_ptr<const TaskSchedule> schedule);

  /// As PlanProblem::at.
  Base& at(double t0, const ContactSituation& contact, const GovernedCommands& commands,
           const PlanConditions& conditions) noexcept;

 private:
  double payload_;  ///< of the model [kg]
  ContinuousProblem<NU> whole_body_;
  FloorLimitedContinuousProblem<NU> floor_limited_;
  LostWheelContinuousProblem<NU> lost_wheel_;
  TractionLimitedContinuousProblem<NU> traction_;
  DisturbedContinuousProblem<NU> disturbed_;
  PushedContinuousProblem<NU> pushed_;
};

}  // namespace ballbot
