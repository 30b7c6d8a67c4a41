#include "controller/pushed_problem.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "controller/added_acceleration.hpp"
#include "controller/input_sizes.hpp"

namespace ballbot {

Push Push::on(const ReducedDynamics& dynamics, const PositionVector& q, const VelocityVector& force,
              double lasts) {
  Push push;
  push.acts = !force.isZero(0);
  if (push.acts) push.acceleration = dynamics.massMatrix(q).ldlt().solve(force);
  push.force = force.head<2>();
  push.lasts = lasts;
  return push;
}

VelocityVector Push::meanAcceleration(double t, double h) const noexcept {
  return lasts / h * (std::exp(-t / lasts) - std::exp(-(t + h) / lasts)) * acceleration;
}

template <int NU>
PushedProblem<NU>::PushedProblem(const std::vector<double>& knots, const Base& inner)
    : WrappedProblem<NU>(inner),
      knots_(knots),
      acceleration_(knots.size() - 1, VelocityVector::Zero()) {}

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
  this->inner().step(k, x, u, next);
  const auto at = static_cast<std::size_t>(k);
  addAcceleration(knots_[at + 1] - knots_[at], x, acceleration_[at], next);
}

template <int NU>
void PushedContinuousProblem<NU>::setTime(double t) noexcept {
  this->inner().setTime(t);
  acceleration_ = std::exp(-t / push_.lasts) * push_.acceleration;
}

template <int NU>
void PushedContinuousProblem<NU>::flow(const X& x, const U& u, X& dx) const noexcept {
  this->inner().flow(x, u, dx);
  dx.template segment<kVelocityDim>(kPositionDim) += acceleration_;
}

template <int NU>
void PushedContinuousProblem<NU>::expand(const X& x, const U& u, X& dx,
                                         Expansion& out) const noexcept {
  this->inner().expand(x, u, dx, out);
  dx.template segment<kVelocityDim>(kPositionDim) += acceleration_;
}

#define BALLBOT_INSTANTIATE(NU)     \
  template class PushedProblem<NU>; \
  template class PushedContinuousProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
