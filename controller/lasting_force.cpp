#include "controller/lasting_force.hpp"

#include <algorithm>

namespace ballbot {
namespace {

VelocityVector byRow(double force, double moment, double arm) {
  VelocityVector out;
  out << force, force, moment, moment, moment, arm, arm, arm;
  return out;
}

}  // namespace

LastingForce::LastingForce(const OffsetFree& settings)
    : settings_(settings),
      change_(byRow(settings.force_change_N, settings.moment_change_Nm, settings.arm_change_Nm)),
      limit_(byRow(settings.force_limit_N, settings.moment_limit_Nm, settings.arm_limit_Nm)) {}

void LastingForce::reset() noexcept {
  started_ = learning_ = false;
  force_.setZero();
}

void LastingForce::update(SimTime now, const VelocityVector& residual, bool explained) noexcept {
  learning_ = false;
  if (!settings_.enabled || !residual.allFinite()) return;
  const double dt = started_ ? toSeconds(now - last_) : 0;
  last_ = now;
  const bool changed =
      !started_ || ((residual - reference_).cwiseAbs().array() > change_.array()).any();
  if (changed) reference_ = residual;
  if (changed || explained) settled_since_ = now;
  started_ = true;
  if (toSeconds(now - settled_since_) < settings_.settled_after) return;
  learning_ = true;
  const double share = std::min(1.0, dt / settings_.time_constant);
  force_ += share * (residual - force_);
  force_ = force_.cwiseMax(-limit_).cwiseMin(limit_);
}

}  // namespace ballbot
