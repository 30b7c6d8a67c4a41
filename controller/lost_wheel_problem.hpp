#pragma once

#include "controller/continuous_problem.hpp"
#include "controller/tasks.hpp"
#include "controller/wrapped_problem.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

/// Two wheels balance or turn, not both: while one is lost nothing is asked about the vertical.
inline void giveUpYaw(Tasks& tasks) noexcept {
  tasks.yaw_weight = 0;
  tasks.ee_orientation_weight.z() = 0;
}

/// A problem whose lost wheels move nothing: their torques cost their squares and nothing else, so
/// that none is planned. What is left to plan with are the others.
template <int NU>
class LostWheelProblem final : public WrappedProblem<NU> {
 public:
  using typename WrappedProblem<NU>::Base;
  using typename WrappedProblem<NU>::X;
  using typename WrappedProblem<NU>::U;
  using typename WrappedProblem<NU>::Stage;

  using WrappedProblem<NU>::WrappedProblem;

  void setLost(const WheelFlags& lost) noexcept { lost_ = lost; }
  bool isLost() const noexcept { return any(lost_); }

  void step(int k, const X& x, const U& u, X& next) const noexcept override;
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;

 private:
  WheelFlags lost_{};
};

/// The same in continuous time.
template <int NU>
class LostWheelContinuousProblem final : public WrappedContinuousProblem<NU> {
 public:
  using typename WrappedContinuousProblem<NU>::Base;
  using typename WrappedContinuousProblem<NU>::X;
  using typename WrappedContinuousProblem<NU>::U;
  using typename WrappedContinuousProblem<NU>::Expansion;

  /// @param whole_body  with all wheels; must outlive this
  explicit LostWheelContinuousProblem(ContinuousProblem<NU>& whole_body)
      : WrappedContinuousProblem<NU>(whole_body), whole_body_(whole_body) {}

  void setLost(const WheelFlags& lost) noexcept { lost_ = lost; }
  bool isLost() const noexcept { return any(lost_); }

  void setTime(double t) noexcept override {
    whole_body_.setTime(t);
    giveUpYaw(whole_body_.tasks());
  }
  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;

 private:
  ContinuousProblem<NU>& whole_body_;
  WheelFlags lost_{};
};

}  // namespace ballbot
