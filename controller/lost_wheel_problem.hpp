#pragma once

#include "controller/continuous_problem.hpp"
#include "controller/cost_terms.hpp"
#include "controller/mpc_dimensions.hpp"
#include "controller/tasks.hpp"
#include "model/wheel_flags.hpp"
#include "solver/continuous_control_problem.hpp"
#include "solver/optimal_control_problem.hpp"

namespace ballbot {

/// Two wheels balance or turn, not both: while one is lost nothing is asked about the vertical.
inline void giveUpYaw(Tasks& tasks) noexcept {
  tasks.yaw_weight = 0;
  tasks.ee_orientation_weight.z() = 0;
}

/// A problem whose lost wheels move nothing: their torques cost their squares and nothing else, so
/// that none is planned. What is left to plan with are the others.
template <int NU>
class LostWheelProblem final : public OptimalControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = OptimalControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Stage = LqStage<kMpcStateDim, NU>;

  /// @param inner  with all wheels; must outlive this
  explicit LostWheelProblem(const Base& inner) : inner_(inner) {}

  void setLost(const WheelFlags& lost) noexcept { lost_ = lost; }
  bool isLost() const noexcept { return any(lost_); }

  int stages() const noexcept override { return inner_.stages(); }
  void step(int k, const X& x, const U& u, X& next) const noexcept override;
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_.addFinalCost(x, terms);
  }
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;
  void approximateFinalCost(const X& x, CostTerms& terms,
                            ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_.approximateFinalCost(x, terms, value);
  }

 private:
  const Base& inner_;
  WheelFlags lost_{};
};

/// The same in continuous time.
template <int NU>
class LostWheelContinuousProblem final
    : public ContinuousControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = ContinuousControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Expansion = typename Base::Expansion;

  /// @param inner  with all wheels; must outlive this
  explicit LostWheelContinuousProblem(ContinuousProblem<NU>& inner) : inner_(inner) {}

  void setLost(const WheelFlags& lost) noexcept { lost_ = lost; }
  bool isLost() const noexcept { return any(lost_); }

  void setTime(double t) noexcept override {
    inner_.setTime(t);
    giveUpYaw(inner_.tasks());
  }
  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;
  void addFinalCost(const X& x, CostTerms& terms) const noexcept override {
    inner_.addFinalCost(x, terms);
  }
  void expandFinalCost(const X& x, ValueFunction<kMpcStateDim>& value) const noexcept override {
    inner_.expandFinalCost(x, value);
  }

 private:
  ContinuousProblem<NU>& inner_;
  WheelFlags lost_{};
};

}  // namespace ballbot
