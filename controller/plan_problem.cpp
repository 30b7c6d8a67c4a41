#include "controller/plan_problem.hpp"

#include "controller/input_sizes.hpp"

namespace ballbot {
namespace {

/// Another mass in the hand is rare, and work.
template <typename Problem>
void takePayload(const PlanConditions& conditions, double& payload, Problem& problem) noexcept {
  if (!conditions.payload || *conditions.payload == payload) return;
  payload = *conditions.payload;
  problem.setPayload(payload);
}

/// Of those that change anything the last one, each around the one before.
template <typename Base, typename Floor, typename Lost, typename Traction, typename Disturbed,
          typename Pushed>
Base* outermost(Base* problem, Floor& floor, Lost& lost, Traction& traction, Disturbed& disturbed,
                Pushed& pushed, const Push& push) noexcept {
  // Without a wheel what the floor holds of a spin is no matter of choice: it balances or turns.
  const bool floor_counts = !lost.isLost() && floor.isLimited();
  if (lost.isLost()) {
    problem = &lost;
  } else if (floor_counts) {
    problem = &floor;
  }
  if (traction.isLimited()) {
    traction.setInner(*problem);
    traction.set(push, floor_counts);
    problem = &traction;
  }
  if (disturbed.isLoaded()) {
    disturbed.setInner(*problem);
    problem = &disturbed;
  }
  if (pushed.isPushed()) {
    pushed.setInner(*problem);
    problem = &pushed;
  }
  return problem;
}

}  // namespace

template <int NU>
PlanProblem<NU>::PlanProblem(const RobotParameters& robot, const Constraints& constraints,
                             const FrequencyShaping& shaping, const TerminalCost& terminal,
                             const std::vector<double>& knots,
                             std::shared_ptr<const TaskSchedule> schedule)
    : payload_(robot.payload_mass),
      schedule_(std::move(schedule)),
      whole_body_(robot, constraints, shaping, terminal, knots),
      floor_limited_(robot, constraints, knots, whole_body_),
      lost_wheel_(whole_body_),
      traction_(robot, constraints, knots, whole_body_),
      disturbed_(shaping, knots, whole_body_),
      pushed_(knots, whole_body_) {}

template <int NU>
const typename PlanProblem<NU>::Base& PlanProblem<NU>::at(
    double t0, const ContactSituation& contact, const GovernedCommands& commands,
    const PlanConditions& conditions) noexcept {
  takePayload(conditions, payload_, whole_body_);
  whole_body_.setTasks(*schedule_, t0, contact, commands);
  floor_limited_.setHeld(conditions.floor_held);
  lost_wheel_.setLost(conditions.lost_wheels);
  if (lost_wheel_.isLost()) {
    for (int k = 0; k <= whole_body_.stages(); ++k) giveUpYaw(whole_body_.tasks(k));
  }
  disturbed_.setLoad(conditions.load);
  pushed_.setPush(conditions.push);
  const Base* innermost = &whole_body_;
  return *outermost(innermost, floor_limited_, lost_wheel_, traction_, disturbed_, pushed_,
                    conditions.push);
}

template <int NU>
ContinuousPlanProblem<NU>::ContinuousPlanProblem(const RobotParameters& robot,
                                                 const Constraints& constraints,
                                                 const FrequencyShaping& shaping,
                                                 const TerminalCost& terminal,
                                                 std::shared_ptr<const TaskSchedule> schedule)
    : payload_(robot.payload_mass),
      whole_body_(robot, constraints, shaping, terminal, std::move(schedule)),
      floor_limited_(robot, constraints, whole_body_),
      lost_wheel_(whole_body_),
      traction_(robot, constraints, whole_body_),
      disturbed_(shaping, whole_body_),
      pushed_(whole_body_) {}

template <int NU>
typename ContinuousPlanProblem<NU>::Base& ContinuousPlanProblem<NU>::at(
    double t0, const ContactSituation& contact, const GovernedCommands& commands,
    const PlanConditions& conditions) noexcept {
  takePayload(conditions, payload_, whole_body_);
  whole_body_.setHorizon(t0, contact, commands);
  floor_limited_.setHeld(conditions.floor_held);
  lost_wheel_.setLost(conditions.lost_wheels);
  disturbed_.setLoad(conditions.load);
  pushed_.setPush(conditions.push);
  Base* innermost = &whole_body_;
  return *outermost(innermost, floor_limited_, lost_wheel_, traction_, disturbed_, pushed_,
                    conditions.push);
}

#define BALLBOT_INSTANTIATE(NU)   \
  template class PlanProblem<NU>; \
  template class ContinuousPlanProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
