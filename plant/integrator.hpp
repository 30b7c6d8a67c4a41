#pragma once

#include <vector>

namespace ballbot {

/// dy/dt = f(t, y), smooth within a step.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;
  virtual void derivative(double t, const double* y, double* ydot) = 0;
};

/// The classical fourth-order Runge-Kutta step. It keeps nothing between steps, so that a state
/// saved and restored continues bit for bit.
class RungeKutta4 {
 public:
  explicit RungeKutta4(int dim) : dim_(dim), k_(4 * static_cast<std::size_t>(dim)), stage_(dim) {}

  /// Takes y from t to t + h [s].
  void step(OdeSystem& system, double t, double h, double* y);

 private:
  int dim_;
  std::vector<double> k_, stage_;
};

}  // namespace ballbot
