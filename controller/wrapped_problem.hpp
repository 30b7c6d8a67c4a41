#pragma once

#include "controller/cost_terms.hpp"
#include "controller/mpc_dimensions.hpp"
#include "solver/continuous_control_problem.hpp"
#include "solver/optimal_control_problem.hpp"

namespace ballbot {

/// A problem around another one, which it leaves as it is: for those that change a part of it. They
/// stand around WholeBodyProblem and not in it because what stands beside that one's code can
/// change how it is compiled, and so its last bits.
template <int NU>
class WrappedProblem : public OptimalControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = OptimalControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Stage = LqStage<kMpcStateDim, NU>;

  /// @param inner  must outlive this
  explicit WrappedProblem(const Base& inner) : inner_(&inner) {}
  void setInner(const Base& inner) noexcept { inner_ = &inner; }
  const Base& inner() const noexcept { return *inner_; }

  int stages() const noexcept override { return inner_->stages(); }
  void step(int k, const X& x, const U& u, X& next) const noexcept override {
    inner_->step(k, x, u, next);
  }
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override {
    inner_->addCost(k, x, u, terms);
  }
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_->addFinalCost(x, terms);
  }
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override {
    inner_->approximate(first, count, x, u, terms, lq);
  }
  void approximateFinalCost(const X& x, CostTerms& terms,
                            ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_->approximateFinalCost(x, terms, value);
  }

 private:
  const Base* inner_;
};

/// The same in continuous time.
template <int NU>
class WrappedContinuousProblem : public ContinuousControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = ContinuousControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Expansion = typename Base::Expansion;

  /// @param inner  must outlive this
  explicit WrappedContinuousProblem(Base& inner) : inner_(&inner) {}
  void setInner(Base& inner) noexcept { inner_ = &inner; }
  Base& inner() const noexcept { return *inner_; }

  void setTime(double t) noexcept override { inner_->setTime(t); }
  void flow(const X& x, const U& u, X& dx) const noexcept override { inner_->flow(x, u, dx); }
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override {
    inner_->addCostRate(x, u, terms);
  }
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override {
    inner_->expand(x, u, dx, out);
  }
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_->addFinalCost(x, terms);
  }
  void expandFinalCost(const X& x, ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_->expandFinalCost(x, value);
  }

 private:
  Base* inner_;
};

}  // namespace ballbot
