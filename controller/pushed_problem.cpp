#include "controller/pushed_problem.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "controller/euler_rates.hpp"

namespace ballbot {

Push Push::on(const ReducedDynamics& dynamics, const PositionVector& q, const VelocityVector& force,
              double lasts) {
  Push push;
  push.acts = !force.isZero(0);
  if (push.acts) push.acceleration = dynamics.massMatrix(q).ldlt().solve(force);
  push.lasts = lasts;
  return push;
}

VelocityVector Push::meanAcceleration(double t, double h) const noexcept {
  return lasts / h * (std::exp(-t / lasts) - std::exp(-(t + h) / lasts)) * acceleration;
}

template <int NU>
PushedProblem<NU>::PushedProblem(const std::vector<double>& knots, const Base& inner)
    : inner_(&inner), knots_(knots), acceleration_(knots.size() - 1, VelocityVector::Zero()) {}

template <int NU>
void PushedProblem<NU>::setPush(const Push& push) noexcept {
  push_ = push;
  if (!push.acts) return;
  for (std::size_t k = 0; k < acceleration_.size(); ++k) {
    acceleration_[k] = push.meanAcceleration(knots_[k], knots_[k + 1] - knots_[k]);
  }
}

template <int NU>
void PushedProblem<NU>::step(int k, const X& x, const U& u, X& next) const noexcept {
  inner_->step(k, x, u, next);
  // As WholeBodyProblem: nu+ has H a more, and q+ = q + H T(q_m) (nu + nu+) / 2.
  const auto at = static_cast<std::size_t>(k);
  const double H = knots_[at + 1] - knots_[at];
  const PositionVector q = x.template head<kPositionDim>();
  const VelocityVector nu = x.template segment<kVelocityDim>(kPositionDim);
  const PositionVector mid = q + 0.5 * H * EulerRates(q).rate(nu);
  next.template segment<kVelocityDim>(kPositionDim) += H * acceleration_[at];
  next.template head<kPositionDim>() += 0.5 * H * H * EulerRates(mid).rate(acceleration_[at]);
}

template <int NU>
void PushedContinuousProblem<NU>::setTime(double t) noexcept {
  inner_->setTime(t);
  acceleration_ = std::exp(-t / push_.lasts) * push_.acceleration;
}

template <int NU>
void PushedContinuousProblem<NU>::flow(const X& x, const U& u, X& dx) const noexcept {
  inner_->flow(x, u, dx);
  dx.template segment<kVelocityDim>(kPositionDim) += acceleration_;
}

template <int NU>
void PushedContinuousProblem<NU>::expand(const X& x, const U& u, X& dx,
                                         Expansion& out) const noexcept {
  inner_->expand(x, u, dx, out);
  dx.template segment<kVelocityDim>(kPositionDim) += acceleration_;
}

template class PushedProblem<6>;
template class PushedProblem<9>;
template class PushedProblem<12>;
template class PushedContinuousProblem<6>;
template class PushedContinuousProblem<9>;
template class PushedContinuousProblem<12>;

}  // namespace ballbot
