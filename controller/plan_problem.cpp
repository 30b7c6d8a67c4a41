#include "controller/plan_problem.hpp"

namespace ballbot {

template <int NU>
PlanProblem<NU>::PlanProblem(const RobotParameters& robot, const Constraints& constraints,
                             const FrequencyShaping& shaping, const TerminalCost& terminal,
                             const std::vector<double>& knots,
                             std::shared_ptr<const TaskSchedule> schedule)
    : schedule_(std::move(schedule)),
      whole_body_(robot, constraints, shaping, terminal, knots),
      floor_limited_(robot, constraints, knots, whole_body_),
      lost_wheel_(whole_body_),
      disturbed_(shaping, knots, whole_body_),
      pushed_(knots, whole_body_) {}

template <int NU>
const typename PlanProblem<NU>::Base& PlanProblem<NU>::at(
    double t0, const ContactSituation& contact, const GovernedCommands& commands) noexcept {
  whole_body_.setTasks(*schedule_, t0, contact, commands);
  const Base* problem = &whole_body_;
  if (floor_limited_.isLimited()) problem = &floor_limited_;
  if (lost_wheel_.isLost()) {
    for (int k = 0; k <= whole_body_.stages(); ++k) giveUpYaw(whole_body_.tasks(k));
    problem = &lost_wheel_;
  }
  if (disturbed_.isLoaded()) {
    disturbed_.setInner(*problem);
    problem = &disturbed_;
  }
  if (pushed_.isPushed()) {
    pushed_.setInner(*problem);
    problem = &pushed_;
  }
  return *problem;
}

template <int NU>
ContinuousPlanProblem<NU>::ContinuousPlanProblem(const RobotParameters& robot,
                                                 const Constraints& constraints,
                                                 const FrequencyShaping& shaping,
                                                 const TerminalCost& terminal,
                                                 std::shared_ptr<const TaskSchedule> schedule)
    : whole_body_(robot, constraints, shaping, terminal, std::move(schedule)),
      floor_limited_(robot, constraints, whole_body_),
      lost_wheel_(whole_body_),
      disturbed_(shaping, whole_body_),
      pushed_(whole_body_) {}

template <int NU>
typename ContinuousPlanProblem<NU>::Base& ContinuousPlanProblem<NU>::at(
    double t0, const ContactSituation& contact, const GovernedCommands& commands) noexcept {
  whole_body_.setHorizon(t0, contact, commands);
  Base* problem = &whole_body_;
  if (floor_limited_.isLimited()) problem = &floor_limited_;
  if (lost_wheel_.isLost()) problem = &lost_wheel_;
  if (disturbed_.isLoaded()) {
    disturbed_.setInner(*problem);
    problem = &disturbed_;
  }
  if (pushed_.isPushed()) {
    pushed_.setInner(*problem);
    problem = &pushed_;
  }
  return *problem;
}

template class PlanProblem<6>;
template class PlanProblem<9>;
template class PlanProblem<12>;
template class ContinuousPlanProblem<6>;
template class ContinuousPlanProblem<9>;
template class ContinuousPlanProblem<12>;

}  // namespace ballbot
