#pragma once

#include <Eigen/Core>

#include "solver/cost_contract.hpp"
#include "solver/riccati.hpp"

namespace ballbot {

/// An optimal control problem in continuous time over a horizon from 0 to T:
///
///   min int_0^T L(t, x, u) dt + L_T(x(T)),   dx/dt = f(t, x, u).
///
/// Calls may not throw; equal arguments give equal bits.
template <int NX, int NU, typename Cost>
class ContinuousControlProblem {
  static_assert(NX >= 1 && NU >= 1, "a problem has at least one state and one input");
  static_assert(IsCost<Cost>::value, "cost_contract.hpp says what a cost needs");

 public:
  using X = Eigen::Matrix<double, NX, 1>;
  using U = Eigen::Matrix<double, NU, 1>;
  using Expansion = LqStage<NX, NU>;  ///< A, B: derivatives of f; costs: of the rate L

  virtual ~ContinuousControlProblem() = default;

  /// The time of all calls that follow, since the horizon's start [s].
  virtual void setTime(double t) noexcept = 0;

  virtual void flow(const X& x, const U& u, X& dx) const noexcept = 0;
  /// Adds L.
  virtual void addCostRate(const X& x, const U& u, Cost& cost) const noexcept = 0;
  /// flow(), and the expansion of f and L with a positive semidefinite Hessian. Overwrites A, B, Q,
  /// q, P, R, r; what is always zero need not be written.
  virtual void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept = 0;

  /// Adds L_T.
  virtual void addFinalCost(const X& x, Cost& cost) const noexcept = 0;
  virtual void expandFinalCost(const X& x, ValueFunction<NX>& value) const noexcept = 0;
};

}  // namespace ballbot
