#include "controller/disturbed_problem.hpp"

#include "controller/added_acceleration.hpp"
#include "controller/input_sizes.hpp"

namespace ballbot {
namespace {

constexpr int kNu = kPositionDim;

}  // namespace

template <int NU>
DisturbedProblem<NU>::DisturbedProblem(const FrequencyShaping& shaping,
                                       const std::vector<double>& knots,
                                       WholeBodyProblem<NU>& whole_body)
    : WrappedProblem<NU>(whole_body), whole_body_(whole_body) {
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    steps_.emplace_back(shaping, knots[k + 1] - knots[k]);
  }
}

template <int NU>
void DisturbedProblem<NU>::step(int k, const X& x, const U& u, X& next) const noexcept {
  this->inner().step(k, x, u, next);
  addAcceleration(steps_[k].H, x, load_.acceleration, next);
}

template <int NU>
void DisturbedProblem<NU>::addTorqueCost(int k, const X& x, const U& u,
                                         CostTerms& terms) const noexcept {
  const Tasks& tasks = whole_body_.tasks(k);
  const FilterStep& f = steps_[k];
  for (int i = 0; i < kWheelCount; ++i) {
    const double s = load_.shift[i], xf = x[kStateDim + i];
    terms.value[kWheelTorqueCost] +=
        0.5 * tasks.wheel_torque_weight * (f.cost(xf - s, u[i] - s) - f.cost(xf, u[i]));
  }
}

template <int NU>
void DisturbedProblem<NU>::addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept {
  this->inner().addCost(k, x, u, terms);
  addTorqueCost(k, x, u, terms);
}

template <int NU>
void DisturbedProblem<NU>::approximate(int first, int count, const X* x, const U* u,
                                       CostTerms* terms, Stage* lq) const noexcept {
  this->inner().approximate(first, count, x, u, terms, lq);
  // The load's acceleration is constant: it moves A by H^2 / 2 dT/dq a alone, which is left out.
  for (int i = 0; i < count; ++i) {
    const int k = first + i;
    addTorqueCost(k, x[i], u[i], terms[i]);
    const Tasks& tasks = whole_body_.tasks(k);
    const FilterStep& f = steps_[k];
    auto r = lq[i].r();
    auto q = lq[i].q();
    for (int j = 0; j < kWheelCount; ++j) {
      const double ws = tasks.wheel_torque_weight * load_.shift[j];
      r[j] -= ws * (f.H + f.c1);
      q[kStateDim + j] += ws * f.c1;
    }
  }
}

template <int NU>
void DisturbedContinuousProblem<NU>::flow(const X& x, const U& u, X& dx) const noexcept {
  this->inner().flow(x, u, dx);
  dx.template segment<kVelocityDim>(kNu) += load_.acceleration;
}

template <int NU>
void DisturbedContinuousProblem<NU>::addCostRate(const X& x, const U& u,
                                                 CostTerms& terms) const noexcept {
  this->inner().addCostRate(x, u, terms);
  const Tasks& tasks = whole_body_.tasks();
  const double rho = shaping_.rho();
  for (int i = 0; i < kWheelCount; ++i) {
    const double s = load_.shift[i];
    const double shaped = rho * u[i] - (rho - 1) * x[kStateDim + i];
    terms.value[kWheelTorqueCost] += 0.5 * tasks.wheel_torque_weight * s * (s - 2 * shaped);
  }
}

template <int NU>
void DisturbedContinuousProblem<NU>::expand(const X& x, const U& u, X& dx,
                                            Expansion& out) const noexcept {
  this->inner().expand(x, u, dx, out);
  dx.template segment<kVelocityDim>(kNu) += load_.acceleration;
  const Tasks& tasks = whole_body_.tasks();
  const double rho = shaping_.rho();
  auto r = out.r();
  auto q = out.q();
  for (int i = 0; i < kWheelCount; ++i) {
    const double ws = tasks.wheel_torque_weight * load_.shift[i];
    r[i] -= ws * rho;
    q[kStateDim + i] += ws * (rho - 1);
  }
}

#define BALLBOT_INSTANTIATE(NU)        \
  template class DisturbedProblem<NU>; \
  template class DisturbedContinuousProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
