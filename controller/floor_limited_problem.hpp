#pragma once

#include <vector>

#include "controller/spin_torque.hpp"
#include "controller/wrapped_problem.hpp"

namespace ballbot {

/// A problem on a floor that holds the ball's spin with a bounded torque: its barrier is added,
/// under the name of the torque limits.
template <int NU>
class FloorLimitedProblem final : public WrappedProblem<NU> {
 public:
  using typename WrappedProblem<NU>::Base;
  using typename WrappedProblem<NU>::X;
  using typename WrappedProblem<NU>::U;
  using typename WrappedProblem<NU>::Stage;

  /// @param knots  of the horizon [s]
  FloorLimitedProblem(const RobotParameters& robot, const Constraints& constraints,
                      const std::vector<double>& knots, const Base& inner);

  /// @param torque  that the floor holds; kUnlimited without end [N m]
  void setHeld(double torque) noexcept { constraints_.takeFloor(torque); }
  bool isLimited() const noexcept { return constraints_.spin_torque_limit < kUnlimited; }

  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;

 private:
  Constraints constraints_;
  SpinTorque spin_torque_;
  std::vector<double> steps_;  ///< length of each stage [s]
};

/// The same in continuous time.
template <int NU>
class FloorLimitedContinuousProblem final : public WrappedContinuousProblem<NU> {
 public:
  using typename WrappedContinuousProblem<NU>::Base;
  using typename WrappedContinuousProblem<NU>::X;
  using typename WrappedContinuousProblem<NU>::U;
  using typename WrappedContinuousProblem<NU>::Expansion;

  FloorLimitedContinuousProblem(const RobotParameters& robot, const Constraints& constraints,
                                Base& inner)
      : WrappedContinuousProblem<NU>(inner), constraints_(constraints), spin_torque_(robot) {}

  /// @param torque  that the floor holds; kUnlimited without end [N m]
  void setHeld(double torque) noexcept { constraints_.takeFloor(torque); }
  bool isLimited() const noexcept { return constraints_.spin_torque_limit < kUnlimited; }

  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;

 private:
  Constraints constraints_;
  SpinTorque spin_torque_;
};

}  // namespace ballbot
