#pragma once

#include <array>
#include <vector>

namespace ballbot {

/// dy/dt = f(t, y), smooth within a step.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;
  virtual void derivative(double t, const double* y, double* ydot) = 0;
};

/// Takes a state from one event to the next. It keeps nothing between steps, so that a state saved
/// and restored continues bit for bit.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Takes y from t to t + h [s].
  virtual void step(OdeSystem& system, double t, double h, double* y) = 0;
};

/// The classical fourth-order Runge-Kutta step.
class RungeKutta4 final : public Integrator {
 public:
  explicit RungeKutta4(int dim) : dim_(dim), k_(4 * static_cast<std::size_t>(dim)), stage_(dim) {}

  void step(OdeSystem& system, double t, double h, double* y) override;

 private:
  int dim_;
  std::vector<double> k_, stage_;
};

/// The same way in as many steps of the pair of Bogacki and Shampine (1989) as an error of
/// `tolerance` per step asks for, each component relative to 1 + |y|. For contacts, whose stiffness
/// rather than accuracy limits a step. Each call begins with the whole interval as first guess.
class ErrorControlledStep final : public Integrator {
 public:
  ErrorControlledStep(int dim, double tolerance);

  /// @throw NumericalError if it would take more than a hundred thousand steps.
  void step(OdeSystem& system, double t, double h, double* y) override;

 private:
  /// One trial of length h from y, whose derivative is in k_[0]; result in next_, its derivative in
  /// k_[3]. @return error over tolerance
  double attempt(OdeSystem& system, double t, double h, const double* y);

  int dim_;
  double tolerance_;
  std::array<std::vector<double>, 4> k_;
  std::vector<double> stage_, next_;
};

}  // namespace ballbot
