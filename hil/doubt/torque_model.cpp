#include "hil/doubt/torque_model.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {

TorqueModel::TorqueModel(double natural_frequency, double damping_ratio, double delay,
                         double period) noexcept {
  const double late = std::clamp(delay, 0.0, period);
  before_ = over(late, natural_frequency, damping_ratio);
  after_ = over(period - late, natural_frequency, damping_ratio);
}

// x'' + 2 D w x' + w^2 x = 0 with x the distance from the command.
TorqueModel::Transition TorqueModel::over(double t, double w, double d) noexcept {
  const double a = d * w, disc = w * w - a * a, wd = std::sqrt(std::abs(disc));
  const double s = wd * t < 1e-9 ? t : disc > 0 ? std::sin(wd * t) / wd : std::sinh(wd * t) / wd;
  const double c = disc > 0 ? std::cos(wd * t) : std::cosh(wd * t);
  const double e = std::exp(-a * t);
  return {e * (c + a * s), e * s, -e * w * w * s, e * (c - a * s)};
}

void TorqueModel::restAt(double torque) noexcept {
  torque_ = last_command_ = torque;
  rate_ = 0;
}

void TorqueModel::apply(const Transition& t, double command) noexcept {
  const double x = torque_ - command, v = rate_;
  torque_ = command + t.xx * x + t.xv * v;
  rate_ = t.vx * x + t.vv * v;
}

void TorqueModel::advance(double command) noexcept {
  apply(before_, last_command_);
  apply(after_, command);
  last_command_ = command;
}

}  // namespace ballbot
