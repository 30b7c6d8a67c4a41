#pragma once

#include "controller/euler_rates.hpp"
#include "controller/mpc_dimensions.hpp"

namespace ballbot {

/// Adds to a step of WholeBodyProblem what an acceleration beside the model's does over it: nu+ has
/// H a more, and q+ = q + H T(q_m) (nu + nu+) / 2.
/// @param x     at the begin of the step, @param next  at its end (q, nu, x_f)
/// @param H     length of the step [s]
/// @param a     of nu, constant over the step
template <typename X>
void addAcceleration(double H, const X& x, const VelocityVector& a, X& next) noexcept {
  const PositionVector q = x.template head<kPositionDim>();
  const VelocityVector nu = x.template segment<kVelocityDim>(kPositionDim);
  const PositionVector mid = q + 0.5 * H * EulerRates(q).rate(nu);
  next.template segment<kVelocityDim>(kPositionDim) += H * a;
  next.template head<kPositionDim>() += 0.5 * H * H * EulerRates(mid).rate(a);
}

}  // namespace ballbot
