#include "controller/traction_limited_problem.hpp"

#include <cmath>

#include "controller/input_sizes.hpp"

namespace ballbot {

template <int NU>
TractionLimitedProblem<NU>::TractionLimitedProblem(const RobotParameters& robot,
                                                   const Constraints& constraints,
                                                   const std::vector<double>& knots,
                                                   const Base& inner)
    : WrappedProblem<NU>(inner),
      margin_(robot, constraints),
      weight_(constraints.traction_weight),
      knots_(knots),
      of_push_(knots.size() - 1, TractionMargin::Rows::Zero()) {}

template <int NU>
void TractionLimitedProblem<NU>::set(const Push& push, bool keeps_tilt) noexcept {
  keeps_tilt_ = keeps_tilt;
  const TractionMargin::Rows at_start = margin_.ofPush(push);
  for (std::size_t k = 0; k < of_push_.size(); ++k) {
    of_push_[k] = std::exp(-knots_[k] / push.lasts) * at_start;
  }
}

template <int NU>
TractionMargin::Rows TractionLimitedProblem<NU>::marginAt(std::size_t k, const X& x,
                                                          const U& u) const noexcept {
  return margin_.at(x.template head<kStateDim>(), u.template head<kJointCount>()) + of_push_[k];
}

template <int NU>
void TractionLimitedProblem<NU>::addCost(int k, const X& x, const U& u,
                                         CostTerms& terms) const noexcept {
  this->inner().addCost(k, x, u, terms);
  const auto at = static_cast<std::size_t>(k);
  const double step = knots_[at + 1] - knots_[at];
  terms.value[kTorqueLimitCost] +=
      tractionCost(marginAt(at, x, u), step * weight_, terms.violation);
}

template <int NU>
void TractionLimitedProblem<NU>::approximate(int first, int count, const X* x, const U* u,
                                             CostTerms* terms, Stage* lq) const noexcept {
  this->inner().approximate(first, count, x, u, terms, lq);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(first + i);
    const double weight = (knots_[at + 1] - knots_[at]) * weight_;
    const TractionMargin::Rows margin = marginAt(at, x[i], u[i]);
    terms[i].value[kTorqueLimitCost] += tractionCost(margin, weight, terms[i].violation);
    expandTractionCost<NU>(margin_, margin, weight, keeps_tilt_, lq[i]);
  }
}

template <int NU>
void TractionLimitedContinuousProblem<NU>::set(const Push& push, bool keeps_tilt) noexcept {
  keeps_tilt_ = keeps_tilt;
  push_lasts_ = push.lasts;
  of_push_ = margin_.ofPush(push);
}

template <int NU>
void TractionLimitedContinuousProblem<NU>::setTime(double t) noexcept {
  this->inner().setTime(t);
  push_left_ = std::exp(-t / push_lasts_);
}

template <int NU>
TractionMargin::Rows TractionLimitedContinuousProblem<NU>::marginAt(const X& x,
                                                                    const U& u) const noexcept {
  return margin_.at(x.template head<kStateDim>(), u.template head<kJointCount>()) +
         push_left_ * of_push_;
}

template <int NU>
void TractionLimitedContinuousProblem<NU>::addCostRate(const X& x, const U& u,
                                                       CostTerms& terms) const noexcept {
  this->inner().addCostRate(x, u, terms);
  terms.value[kTorqueLimitCost] += tractionCost(marginAt(x, u), weight_, terms.violation);
}

template <int NU>
void TractionLimitedContinuousProblem<NU>::expand(const X& x, const U& u, X& dx,
                                                  Expansion& out) const noexcept {
  this->inner().expand(x, u, dx, out);
  expandTractionCost<NU>(margin_, marginAt(x, u), weight_, keeps_tilt_, out);
}

#define BALLBOT_INSTANTIATE(NU)              \
  template class TractionLimitedProblem<NU>; \
  template class TractionLimitedContinuousProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
