#include "controller/continuous_engine.hpp"

#include "controller/input_sizes.hpp"
#include "controller/policy_guess.hpp"

namespace ballbot {
namespace {

/// Absolute tolerances relative to those of the cost: positions are small numbers.
MpcState stateSize() {
  MpcState out = MpcState::Ones();
  out.head<kPositionDim>().setConstant(0.1);
  return out;
}

}  // namespace

template <int NU>
ContinuousEngine<NU>::ContinuousEngine(const RobotParameters& robot, const Constraints& constraints,
                                       const FrequencyShaping& shaping,
                                       const TerminalCost& terminal,
                                       const std::vector<double>& knots,
                                       std::shared_ptr<const TaskSchedule> schedule,
                                       const SlqOptions& options,
                                       const ContinuousOptions& continuous)
    : problem_(robot, constraints, shaping, terminal, std::move(schedule)),
      solver_(knots, options, continuous, stateSize()) {}

template <int NU>
MpcPolicy ContinuousEngine<NU>::emptyPolicy() const {
  const auto& knots = solver_.knots();
  const int n = static_cast<int>(knots.size());
  MpcPolicy out(n, n);
  for (int k = 0; k < n; ++k) {
    out.knots()[k].time = out.controls()[k].time = knots[k];
    out.controls()[k].u.setZero();
    out.controls()[k].K.setZero();
  }
  return out;
}

template <int NU>
MpcSolveReport ContinuousEngine<NU>::solve(SimTime now, const MpcState& x0, const MpcPolicy& guess,
                                           int iterations, MpcPolicy& out) noexcept {
  typename ContinuousPlanProblem<NU>::Base& problem =
      problem_.at(toSeconds(now), contact_, commands_, conditions_);
  const double age = toSeconds(now - guess.stamp());
  const MpcSolveReport report = solver_.solve(problem, x0, PolicyGuess<NU>(guess), age, iterations);
  if (report.ok()) setPolicy(solver_.solution(), now, out);
  return report;
}

#define BALLBOT_INSTANTIATE(NU) template class ContinuousEngine<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
