#pragma once

#include <memory>

namespace ballbot {

/// Explicit Runge-Kutta with error control (SUNDIALS ARKODE's ERKStep, fifth order), for the
/// continuous-time solver. Every run starts afresh from the same initial step, so that equal inputs
/// give equal bits whatever was integrated before.
class ErkIntegrator {
 public:
  /// dy = f(t, y); may not throw.
  using Flow = void (*)(double t, const double* y, double* dy, void* user);

  /// @param absolute  tolerance of each of the `dimension` components
  ErkIntegrator(int dimension, Flow flow, void* user, double relative, const double* absolute,
                double initial_step);
  ~ErkIntegrator();
  ErkIntegrator(const ErkIntegrator&) = delete;
  ErkIntegrator& operator=(const ErkIntegrator&) = delete;

  /// Begins at time t from y.
  bool start(double t, const double* y) noexcept;
  /// Steps until exactly t, later than where it stands. False if steps became too small or too
  /// many, or the flow is not finite; y is then of no use.
  bool advanceTo(double t) noexcept;
  const double* y() const noexcept;

  /// Calls of the flow since start().
  long flowCalls() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
