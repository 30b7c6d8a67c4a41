#include "plant/integrator.hpp"

namespace ballbot {

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

}  // namespace ballbot
