#include "controller/push_belief.hpp"

#include <algorithm>
#include <cmath>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

/// Of the least that is a push, from where on all of it is one.
constexpr double kWhole = 1.5;

}  // namespace

void PushBelief::describe(ConfigVisitor& v) {
  v.boolean(may("counted_on",
                "whether plans count on a push that acts now to go on for a while; where plans "
                "have contact forces, never"),
            counted_on);
  v.number(may("lasts_s", "time over which plans let a push fade"), lasts, {0.01, 10});
  v.number(may("least_force_N", "force along the floor above which it is a push"), least_force,
           {0.1, 1e3});
  v.number(may("least_moment_Nm", "moment about the ball's centre above which it is a push"),
           least_moment, {0.1, 1e3});
  v.duration(
      may("doubted_for_ms", "how long nothing is taken for a push after a measurement was refused"),
      doubted_for, {0, 1e4});
}

void PushEstimate::update(SimTime now, const VelocityVector& residual, bool doubtful) noexcept {
  force_.setZero();
  if (!settings_.counted_on) return;
  if (doubtful) doubted_until_ = now + settings_.doubted_for;
  if (now < doubted_until_ || !residual.allFinite()) return;
  const double size = std::hypot(residual.segment<2>(kBallVx).norm() / settings_.least_force,
                                 residual.segment<2>(kOmegaX).norm() / settings_.least_moment);
  if (size <= 1) return;
  force_ = std::min(1.0, (size - 1) / (kWhole - 1)) * residual;
  force_[kOmegaZ] = 0;
}

}  // namespace ballbot
