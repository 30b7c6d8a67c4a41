#pragma once

#include <vector>

#include "controller/continuous_problem.hpp"
#include "controller/whole_body_problem.hpp"

namespace ballbot {

/// A push as a plan takes it: what it does to the motion where the plan begins, and how long.
struct Push {
  bool acts = false;
  VelocityVector acceleration = VelocityVector::Zero();  ///< of nu, at the plan's start
  double lasts = 1;                                      ///< time constant of its fading [s]

  /// @param q      where the plan begins
  /// @param force  in the rows of nu [N, N m]
  static Push on(const ReducedDynamics& dynamics, const PositionVector& q,
                 const VelocityVector& force, double lasts);
  /// Mean from t to t + h after the plan's start.
  VelocityVector meanAcceleration(double t, double h) const noexcept;
};

/// A problem of a robot that is pushed: the acceleration, which fades, is part of the motion.
/// Around the other problems for the reason that FloorLimitedProblem is one.
template <int NU>
class PushedProblem final : public OptimalControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = OptimalControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Stage = LqStage<kMpcStateDim, NU>;

  /// @param inner  without the push; must outlive this
  /// @param knots  of its horizon [s]
  PushedProblem(const std::vector<double>& knots, const Base& inner);

  void setPush(const Push& push) noexcept;
  bool isPushed() const noexcept { return push_.acts; }
  void setInner(const Base& inner) noexcept { inner_ = &inner; }

  int stages() const noexcept override { return inner_->stages(); }
  void step(int k, const X& x, const U& u, X& next) const noexcept override;
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override {
    inner_->addCost(k, x, u, terms);
  }
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_->addFinalCost(x, terms);
  }
  /// The push does not depend on the state.
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
  Push push_;
  std::vector<double> knots_;                 ///< [s]
  std::vector<VelocityVector> acceleration_;  ///< by the push, one per stage
};

/// The same in continuous time.
template <int NU>
class PushedContinuousProblem final : public ContinuousControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = ContinuousControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Expansion = typename Base::Expansion;

  /// @param inner  without the push; must outlive this
  explicit PushedContinuousProblem(Base& inner) : inner_(&inner) {}

  void setPush(const Push& push) noexcept { push_ = push; }
  bool isPushed() const noexcept { return push_.acts; }
  void setInner(Base& inner) noexcept { inner_ = &inner; }

  void setTime(double t) noexcept override;
  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override {
    inner_->addCostRate(x, u, terms);
  }
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_->addFinalCost(x, terms);
  }
  void expandFinalCost(const X& x, ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_->expandFinalCost(x, value);
  }

 private:
  Base* inner_;
  Push push_;
  VelocityVector acceleration_ = VelocityVector::Zero();  ///< at the time that was set
};

}  // namespace ballbot
