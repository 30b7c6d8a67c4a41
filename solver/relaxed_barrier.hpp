#pragma once

#include <cmath>

namespace ballbot {

/// Relaxed logarithmic barrier for h >= 0: -mu ln h down to h = delta, below that the quadratic
/// that continues value, slope and curvature, so that an infeasible point has a finite cost.
struct RelaxedBarrier {
  double mu = 0.1;     ///< weight
  double delta = 0.5;  ///< where the relaxation takes over, in the unit of h

  struct Derivatives {
    double value, first, second;
  };

  double value(double h) const {
    if (h > delta) return -mu * std::log(h);
    const double z = (h - 2 * delta) / delta;
    return mu * (0.5 * z * z - 0.5 - std::log(delta));
  }
  Derivatives derivatives(double h) const {
    if (h > delta) return {-mu * std::log(h), -mu / h, mu / (h * h)};
    const double z = (h - 2 * delta) / delta;
    return {mu * (0.5 * z * z - 0.5 - std::log(delta)), mu * z / delta, mu / (delta * delta)};
  }
};

}  // namespace ballbot
