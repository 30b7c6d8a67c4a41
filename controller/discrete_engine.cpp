#include "controller/discrete_engine.hpp"

#include "controller/input_sizes.hpp"
#include "controller/policy_guess.hpp"

namespace ballbot {

template <int NU>
DiscreteEngine<NU>::DiscreteEngine(const RobotParameters& robot, const Constraints& constraints,
                                   const FrequencyShaping& shaping, const TerminalCost& terminal,
                                   const std::vector<double>& knots,
                                   std::shared_ptr<const TaskSchedule> schedule,
                                   const SlqOptions& options)
    : problem_(robot, constraints, shaping, terminal, knots, std::move(schedule)),
      solver_(knots, options) {}

template <int NU>
MpcPolicy DiscreteEngine<NU>::emptyPolicy() const {
  const auto& knots = solver_.knots();
  MpcPolicy out(static_cast<int>(knots.size()), problem_.stages());
  for (std::size_t k = 0; k < knots.size(); ++k) out.knots()[k].time = knots[k];
  for (int k = 0; k < problem_.stages(); ++k) {
    out.controls()[k].time = solver_.controlTimes()[k];
    out.controls()[k].u.setZero();
    out.controls()[k].K.setZero();
  }
  return out;
}

template <int NU>
MpcSolveReport DiscreteEngine<NU>::solve(SimTime now, const MpcState& x0, const MpcPolicy& guess,
                                         int iterations, MpcPolicy& out) noexcept {
  const typename PlanProblem<NU>::Base& problem =
      problem_.at(toSeconds(now), contact_, commands_, conditions_);
  const double age = toSeconds(now - guess.stamp());
  const MpcSolveReport report = solver_.solve(problem, x0, PolicyGuess<NU>(guess), age, iterations);
  if (report.ok()) setPolicy(solver_.solution(), now, out);
  return report;
}

#define BALLBOT_INSTANTIATE(NU) template class DiscreteEngine<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
