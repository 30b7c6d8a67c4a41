#include "controller/floor_limited_problem.hpp"

#include "controller/input_sizes.hpp"

namespace ballbot {

template <int NU>
FloorLimitedProblem<NU>::FloorLimitedProblem(const RobotParameters& robot,
                                             const Constraints& constraints,
                                             const std::vector<double>& knots, const Base& inner)
    : WrappedProblem<NU>(inner), constraints_(constraints), spin_torque_(robot) {
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) steps_.push_back(knots[k + 1] - knots[k]);
}

template <int NU>
void FloorLimitedProblem<NU>::addCost(int k, const X& x, const U& u,
                                      CostTerms& terms) const noexcept {
  this->inner().addCost(k, x, u, terms);
  terms.value[kTorqueLimitCost] +=
      spinTorqueCost(spin_torque_, constraints_, x.template head<kStateDim>(),
                     u.template head<kWheelCount>(), steps_[k], terms.violation);
}

template <int NU>
void FloorLimitedProblem<NU>::approximate(int first, int count, const X* x, const U* u,
                                          CostTerms* terms, Stage* lq) const noexcept {
  this->inner().approximate(first, count, x, u, terms, lq);
  for (int i = 0; i < count; ++i) {
    const StateVector robot = x[i].template head<kStateDim>();
    const Vector3 tau = u[i].template head<kWheelCount>();
    const double step = steps_[first + i];
    terms[i].value[kTorqueLimitCost] +=
        spinTorqueCost(spin_torque_, constraints_, robot, tau, step, terms[i].violation);
    expandSpinTorqueCost<NU>(spin_torque_, constraints_, robot, tau, step, lq[i]);
  }
}

template <int NU>
void FloorLimitedContinuousProblem<NU>::addCostRate(const X& x, const U& u,
                                                    CostTerms& terms) const noexcept {
  this->inner().addCostRate(x, u, terms);
  terms.value[kTorqueLimitCost] +=
      spinTorqueCost(spin_torque_, constraints_, x.template head<kStateDim>(),
                     u.template head<kWheelCount>(), 1, terms.violation);
}

template <int NU>
void FloorLimitedContinuousProblem<NU>::expand(const X& x, const U& u, X& dx,
                                               Expansion& out) const noexcept {
  this->inner().expand(x, u, dx, out);
  expandSpinTorqueCost<NU>(spin_torque_, constraints_, x.template head<kStateDim>(),
                           u.template head<kWheelCount>(), 1, out);
}

#define BALLBOT_INSTANTIATE(NU)           \
  template class FloorLimitedProblem<NU>; \
  template class FloorLimitedContinuousProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
