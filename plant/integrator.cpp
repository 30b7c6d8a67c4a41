#include "plant/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr int kMostSteps = 100'000;

}  // namespace

void RungeKutta4::step(OdeSystem& system, double t, double h, double* y) {
  double* k1 = k_.data();
  double* k2 = k1 + dim_;
  double* k3 = k2 + dim_;
  double* k4 = k3 + dim_;
  double* stage = stage_.data();

  system.derivative(t, y, k1);
  for (int i = 0; i < dim_; ++i) stage[i] = y[i] + 0.5 * h * k1[i];
  system.derivative(t + 0.5 * h, stage, k2);
  for (int i = 0; i < dim_; ++i) stage[i] = y[i] + 0.5 * h * k2[i];
  system.derivative(t + 0.5 * h, stage, k3);
  for (int i = 0; i < dim_; ++i) stage[i] = y[i] + h * k3[i];
  system.derivative(t + h, stage, k4);
  for (int i = 0; i < dim_; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}

ErrorControlledStep::ErrorControlledStep(int dim, double tolerance)
    : dim_(dim), tolerance_(tolerance), stage_(dim), next_(dim) {
  for (std::vector<double>& k : k_) k.resize(dim);
}

double ErrorControlledStep::attempt(OdeSystem& system, double t, double h, const double* y) {
  const auto& [k1, k2, k3, k4] = k_;
  for (int i = 0; i < dim_; ++i) stage_[i] = y[i] + 0.5 * h * k1[i];
  system.derivative(t + 0.5 * h, stage_.data(), k_[1].data());
  for (int i = 0; i < dim_; ++i) stage_[i] = y[i] + 0.75 * h * k2[i];
  system.derivative(t + 0.75 * h, stage_.data(), k_[2].data());
  for (int i = 0; i < dim_; ++i) next_[i] = y[i] + h / 9 * (2 * k1[i] + 3 * k2[i] + 4 * k3[i]);
  system.derivative(t + h, next_.data(), k_[3].data());
  double worst = 0;
  for (int i = 0; i < dim_; ++i) {
    const double error = h / 72 * (-5 * k1[i] + 6 * k2[i] + 8 * k3[i] - 9 * k4[i]);
    const double ratio = std::abs(error) / (tolerance_ * (1 + std::abs(y[i])));
    if (!std::isfinite(ratio)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, ratio);
  }
  return worst;
}

void ErrorControlledStep::step(OdeSystem& system, double t, double h, double* y) {
  const double end = t + h;
  double wanted = h;
  system.derivative(t, y, k_[0].data());
  for (int n = 0; n < kMostSteps; ++n) {
    const bool last = t + wanted >= end - 1e-6 * h;
    const double length = last ? end - t : wanted;
    const double error = attempt(system, t, length, y);
    if (error <= 1) {
      std::copy(next_.begin(), next_.end(), y);
      if (last) return;
      std::swap(k_[0], k_[3]);
      t += length;
    }
    const double growth = error > 0 ? 0.9 * std::cbrt(1 / error) : 5;
    wanted = length * (growth >= 0.2 ? std::min(growth, 5.0) : 0.2);
  }
  throw NumericalError(
      fmt::format("{} steps did not suffice for {:.3g} s within an error of {:g} each", kMostSteps,
                  h, tolerance_));
}

}  // namespace ballbot
