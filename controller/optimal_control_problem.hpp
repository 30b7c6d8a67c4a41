#pragma once

#include <Eigen/Core>

#include "controller/cost_terms.hpp"
#include "controller/riccati.hpp"

namespace ballbot {

/// A discrete optimal control problem over N stages, as the solver sees it:
///
///   min sum_k L_k(x_k, u_k) + L_N(x_N),   x_k+1 = F_k(x_k, u_k).
///
/// All calls are const, free of allocation and of shared state: two threads may use one problem.
template <int NX, int NU>
class OptimalControlProblem {
 public:
  using X = Eigen::Matrix<double, NX, 1>;
  using U = Eigen::Matrix<double, NU, 1>;

  virtual ~OptimalControlProblem() = default;
  virtual int stages() const noexcept = 0;

  virtual void step(int k, const X& x, const U& u, X& next) const noexcept = 0;
  /// Adds L_k to `terms`.
  virtual void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept = 0;
  /// Adds L_N to `terms`.
  virtual void addFinalCost(const X& x, CostTerms& terms) const noexcept = 0;

  /// What a trajectory is approximated by, stage after stage: `count` stages from stage `first` on,
  /// all arrays beginning at that one. Overwrites A, B, Q, q, P, R, r of lq[i], with a positive
  /// semidefinite Hessian, and adds the stage's cost to terms[i]. Each stage gets the same bits
  /// whatever it is computed together with.
  virtual void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                           LqStage<NX, NU>* lq) const noexcept = 0;
  /// addFinalCost(), with its second-order expansion, positive semidefinite.
  virtual void approximateFinalCost(const X& x, CostTerms& terms,
                                    ValueFunction<NX>& value) const noexcept = 0;
};

}  // namespace ballbot
