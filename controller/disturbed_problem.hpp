#pragma once

#include "controller/continuous_problem.hpp"
#include "controller/lasting_load.hpp"
#include "controller/whole_body_problem.hpp"

namespace ballbot {

/// The whole-body problem, on whatever floor, of a robot on which a force acts that lasts: its
/// acceleration is part of the motion, and torques cost as much as they differ from those without
/// it by what it takes to stand still. A problem of its own, around the other, for the reason that
/// FloorLimitedProblem is one.
template <int NU>
class DisturbedProblem final : public OptimalControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = OptimalControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Stage = LqStage<kMpcStateDim, NU>;

  /// @param whole_body  whose tasks say what torques cost; must outlive this
  /// @param knots  of its horizon [s]
  DisturbedProblem(const FrequencyShaping& shaping, const std::vector<double>& knots,
                   WholeBodyProblem<NU>& whole_body);

  void setLoad(const LastingLoad& load) noexcept { load_ = load; }
  bool isLoaded() const noexcept { return load_.acts; }
  /// The problem without the load, which must outlive the next solve.
  void setInner(const Base& inner) noexcept { inner_ = &inner; }

  int stages() const noexcept override { return inner_->stages(); }
  void step(int k, const X& x, const U& u, X& next) const noexcept override;
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_->addFinalCost(x, terms);
  }
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;
  void approximateFinalCost(const X& x, CostTerms& terms,
                            ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_->approximateFinalCost(x, terms, value);
  }

 private:
  /// What torques cost more for being meant about the load's.
  void addTorqueCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept;

  WholeBodyProblem<NU>& whole_body_;
  const Base* inner_;
  std::vector<FilterStep> steps_;  ///< one per stage
  LastingLoad load_;
};

/// The same in continuous time.
template <int NU>
class DisturbedContinuousProblem final
    : public ContinuousControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = ContinuousControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Expansion = typename Base::Expansion;

  DisturbedContinuousProblem(const FrequencyShaping& shaping, ContinuousProblem<NU>& whole_body)
      : shaping_(shaping), whole_body_(whole_body), inner_(&whole_body) {}

  void setLoad(const LastingLoad& load) noexcept { load_ = load; }
  bool isLoaded() const noexcept { return load_.acts; }
  void setInner(Base& inner) noexcept { inner_ = &inner; }

  void setTime(double t) noexcept override { inner_->setTime(t); }
  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_->addFinalCost(x, terms);
  }
  void expandFinalCost(const X& x, ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_->expandFinalCost(x, value);
  }

 private:
  FrequencyShaping shaping_;
  ContinuousProblem<NU>& whole_body_;
  Base* inner_;
  LastingLoad load_;
};

}  // namespace ballbot
