#include "hil/tilt_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

void normalize(std::array<double, 3>& v) noexcept {
  const double norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(norm > 1e-6)) return;
  for (double& x : v) x /= norm;
}

}  // namespace

void TiltMonitor::update(double dt, const std::array<double, 3>& accel,
                         const std::array<double, 3>& gyro) noexcept {
  std::array<double, 3> measured = accel;
  normalize(measured);
  if (!started_) {
    up_ = measured;
    started_ = true;
    return;
  }
  // The vertical is fixed in the world: d(up)/dt = up x w in the base's axes.
  const std::array<double, 3> u = up_;
  const std::array<double, 3>& w = gyro;
  const std::array<double, 3> turned = {u[0] + dt * (u[1] * w[2] - u[2] * w[1]),
                                        u[1] + dt * (u[2] * w[0] - u[0] * w[2]),
                                        u[2] + dt * (u[0] * w[1] - u[1] * w[0])};
  const double share = std::min(1.0, dt / time_constant_);
  for (std::size_t i = 0; i < 3; ++i) up_[i] = turned[i] + share * (measured[i] - turned[i]);
  normalize(up_);
}

double TiltMonitor::tilt() const noexcept { return std::acos(std::clamp(up_[2], -1.0, 1.0)); }

}  // namespace ballbot
