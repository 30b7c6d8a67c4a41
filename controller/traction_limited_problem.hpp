#pragma once

#include <vector>

#include "controller/traction_margin.hpp"
#include "controller/wrapped_problem.hpp"

namespace ballbot {

/// A problem of a robot whose wheels slip on the ball beyond what friction holds: what they lack is
/// added to the cost, under the name of the torque limits. Nothing where they lack nothing.
template <int NU>
class TractionLimitedProblem final : public WrappedProblem<NU> {
 public:
  using typename WrappedProblem<NU>::Base;
  using typename WrappedProblem<NU>::X;
  using typename WrappedProblem<NU>::U;
  using typename WrappedProblem<NU>::Stage;

  /// @param knots  of the horizon [s]
  TractionLimitedProblem(const RobotParameters& robot, const Constraints& constraints,
                         const std::vector<double>& knots, const Base& inner);

  bool isLimited() const noexcept { return margin_.isLimited(); }
  /// @param keeps_tilt  the inner problem writes cross terms of the tilt and the wheels
  void set(const Push& push, bool keeps_tilt) noexcept;

  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;

 private:
  TractionMargin::Rows marginAt(std::size_t k, const X& x, const U& u) const noexcept;

  TractionMargin margin_;
  double weight_;
  bool keeps_tilt_ = false;
  std::vector<double> knots_;                  ///< [s]
  std::vector<TractionMargin::Rows> of_push_;  ///< one per stage
};

/// The same in continuous time.
template <int NU>
class TractionLimitedContinuousProblem final : public WrappedContinuousProblem<NU> {
 public:
  using typename WrappedContinuousProblem<NU>::Base;
  using typename WrappedContinuousProblem<NU>::X;
  using typename WrappedContinuousProblem<NU>::U;
  using typename WrappedContinuousProblem<NU>::Expansion;

  TractionLimitedContinuousProblem(const RobotParameters& robot, const Constraints& constraints,
                                   Base& inner)
      : WrappedContinuousProblem<NU>(inner),
        margin_(robot, constraints),
        weight_(constraints.traction_weight) {}

  bool isLimited() const noexcept { return margin_.isLimited(); }
  void set(const Push& push, bool keeps_tilt) noexcept;

  void setTime(double t) noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;

 private:
  TractionMargin::Rows marginAt(const X& x, const U& u) const noexcept;

  TractionMargin margin_;
  double weight_;
  bool keeps_tilt_ = false;
  double push_lasts_ = 1, push_left_ = 1;  ///< [s], and the share at the time that was set
  TractionMargin::Rows of_push_ = TractionMargin::Rows::Zero();
};

}  // namespace ballbot
