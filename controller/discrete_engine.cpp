#include "controller/discrete_engine.hpp"

namespace ballbot {

template <int NU>
DiscreteEngine<NU>::DiscreteEngine(const RobotParameters& robot, const Constraints& constraints,
                                   const FrequencyShaping& shaping, const TerminalCost& terminal,
                                   const std::vector<double>& knots,
                                   std::shared_ptr<const TaskSchedule> schedule,
                                   const SlqOptions& options)
    : knots_(knots),
      schedule_(std::move(schedule)),
      problem_(robot, constraints, shaping, terminal, knots),
      solver_(problem_.stages(), options) {}

template <int NU>
MpcPolicy DiscreteEngine<NU>::emptyPolicy() const {
  MpcPolicy out(static_cast<int>(knots_.size()), problem_.stages());
  for (std::size_t k = 0; k < knots_.size(); ++k) out.knots()[k].time = knots_[k];
  for (int k = 0; k < problem_.stages(); ++k) {
    out.controls()[k].time = 0.5 * (knots_[k] + knots_[k + 1]);
    out.controls()[k].u.setZero();
    out.controls()[k].K.setZero();
  }
  return out;
}

template <int NU>
SlqReport DiscreteEngine<NU>::solve(SimTime now, const MpcState& x0, const MpcPolicy& guess,
                                    int iterations, MpcPolicy& out) noexcept {
  problem_.setTasks(*schedule_, toSeconds(now), contact_, commands_);

  // The guess is read by time: no index is shifted, so any period and any grid will do.
  auto& nominal = solver_.nominal();
  const double age = toSeconds(now - guess.stamp());
  MpcInput u;
  MpcGain K;
  for (int k = 0; k < problem_.stages(); ++k) {
    nominal.x[k] = guess.stateAt(age + knots_[k]);
    guess.controlAt(age + 0.5 * (knots_[k] + knots_[k + 1]), u, K);
    nominal.u[k] = u.template head<NU>();
    nominal.gain[k].K() = K.template topRows<NU>();
  }

  const SlqReport report = iterations == 1 ? solver_.iterate(problem_, x0)
                                           : solver_.converge(problem_, x0, iterations, 1e-9);
  if (!report.ok()) return report;
  const auto& solution = solver_.solution();
  for (int k = 0; k <= problem_.stages(); ++k) out.knots()[k].x = solution.x[k];
  for (int k = 0; k < problem_.stages(); ++k) {
    out.controls()[k].u.template head<NU>() = solution.u[k];
    out.controls()[k].K.template topRows<NU>() = solution.gain[k].K();
  }
  out.setValid(now);
  return report;
}

template class DiscreteEngine<6>;
template class DiscreteEngine<9>;
template class DiscreteEngine<12>;

}  // namespace ballbot
