#pragma once

#include <vector>

#include "controller/wrapped_problem.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// A push as a plan takes it: what it does to the motion where the plan begins, and how long.
struct Push {
  bool acts = false;
  VelocityVector acceleration = VelocityVector::Zero();  ///< of nu, at the plan's start
  Eigen::Vector2d force = Eigen::Vector2d::Zero();       ///< its horizontal part in W [N]
  double lasts = 1;                                      ///< time constant of its fading [s]

  /// @param q      where the plan begins
  /// @param force  in the rows of nu [N, N m]
  static Push on(const ReducedDynamics& dynamics, const PositionVector& q,
                 const VelocityVector& force, double lasts);
  /// Mean from t to t + h after the plan's start.
  VelocityVector meanAcceleration(double t, double h) const noexcept;
};

/// A problem of a robot that is pushed: the acceleration, which fades, is part of the motion. It
/// does not depend on the state, and so changes no expansion.
template <int NU>
class PushedProblem final : public WrappedProblem<NU> {
 public:
  using typename WrappedProblem<NU>::Base;
  using typename WrappedProblem<NU>::X;
  using typename WrappedProblem<NU>::U;
  using typename WrappedProblem<NU>::Stage;

  /// @param knots  of the horizon [s]
  PushedProblem(const std::vector<double>& knots, const Base& inner);

  void setPush(const Push& push) noexcept;
  bool isPushed() const noexcept { return push_.acts; }

  void step(int k, const X& x, const U& u, X& next) const noexcept override;

 private:
  Push push_;
  std::vector<double> knots_;                 ///< [s]
  std::vector<VelocityVector> acceleration_;  ///< by the push, one per stage
};

/// The same in continuous time.
template <int NU>
class PushedContinuousProblem final : public WrappedContinuousProblem<NU> {
 public:
  using typename WrappedContinuousProblem<NU>::Base;
  using typename WrappedContinuousProblem<NU>::X;
  using typename WrappedContinuousProblem<NU>::U;
  using typename WrappedContinuousProblem<NU>::Expansion;

  using WrappedContinuousProblem<NU>::WrappedContinuousProblem;

  void setPush(const Push& push) noexcept { push_ = push; }
  bool isPushed() const noexcept { return push_.acts; }

  void setTime(double t) noexcept override;
  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;

 private:
  Push push_;
  VelocityVector acceleration_ = VelocityVector::Zero();  ///< at the time that was set
};

}  // namespace ballbot
