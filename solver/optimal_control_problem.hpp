#pragma once

#include <Eigen/Core>

#include "solver/cost_contract.hpp"
#include "solver/riccati.hpp"

namespace ballbot {

/// A discrete optimal control problem over N stages, as the solver sees it:
///
///   min sum_k L_k(x_k, u_k) + L_N(x_N),   x_k+1 = F_k(x_k, u_k).
///
/// NX states and NU inputs, each at least one. All calls are const, free of allocation and of
/// shared state: two threads may use one problem. Equal arguments give equal bits.
template <int NX, int NU, typename Cost>
class OptimalControlProblem {
  static_assert(NX >= 1 && NU >= 1, "a problem has at least one state and one input");
  static_assert(IsCost<Cost>::value, "cost_contract.hpp says what a cost needs");

 public:
  using X = Eigen::Matrix<double, NX, 1>;
  using U = Eigen::Matrix<double, NU, 1>;

  virtual ~OptimalControlProblem() = default;
  virtual int stages() const noexcept = 0;

  virtual void step(int k, const X& x, const U& u, X& next) const noexcept = 0;
  /// Adds L_k to `cost`.
  virtual void addCost(int k, const X& x, const U& u, Cost& cost) const noexcept = 0;
  /// Adds L_N to `cost`.
  virtual void addFinalCost(const X& x, Cost& cost) const noexcept = 0;

  /// What a trajectory is approximated by, stage after stage: `count` stages from stage `first` on,
  /// all arrays beginning at that one. Overwrites A, B, Q, q, P, R, r of lq[i], with a positive
  /// semidefinite Hessian, and adds the stage's cost to cost[i]. Each stage gets the same bits
  /// whatever it is computed together with. What is always zero need not be written: a stage begins
  /// as zero, and the solver leaves it as it was written.
  virtual void approximate(int first, int count, const X* x, const U* u, Cost* cost,
                           LqStage<NX, NU>* lq) const noexcept = 0;
  /// addFinalCost(), with its second-order expansion, positive semidefinite.
  virtual void approximateFinalCost(const X& x, Cost& cost,
                                    ValueFunction<NX>& value) const noexcept = 0;
};

}  // namespace ballbot
