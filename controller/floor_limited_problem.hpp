#pragma once

#include "controller/continuous_problem.hpp"
#include "controller/spin_torque.hpp"
#include "controller/whole_body_problem.hpp"

namespace ballbot {

/// The whole-body problem on a floor that holds the ball's spin with a bounded torque: its barrier
/// is added, under the name of the torque limits. A problem of its own, around the other, because
/// what stands beside that one's code can change how it is compiled, and so its last bits.
template <int NU>
class FloorLimitedProblem final : public OptimalControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = OptimalControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Stage = LqStage<kMpcStateDim, NU>;

  /// @param inner  must outlive this
  /// @param knots  of its horizon [s]
  FloorLimitedProblem(const RobotParameters& robot, const Constraints& constraints,
                      const std::vector<double>& knots, const WholeBodyProblem<NU>& inner);

  /// @param torque  that the floor holds; kUnlimited without end [N m]
  void setHeld(double torque) noexcept { constraints_.takeFloor(torque); }
  bool isLimited() const noexcept { return constraints_.spin_torque_limit < kUnlimited; }

  int stages() const noexcept override { return inner_.stages(); }
  void step(int k, const X& x, const U& u, X& next) const noexcept override {
    inner_.step(k, x, u, next);
  }
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
  const WholeBodyProblem<NU>& inner_;
  Constraints constraints_;
  SpinTorque spin_torque_;
  std::vector<double> steps_;  ///< length of each stage [s]
};

/// The same in continuous time.
template <int NU>
class FloorLimitedContinuousProblem final
    : public ContinuousControlProblem<kMpcStateDim, NU, CostTerms> {
 public:
  using Base = ContinuousControlProblem<kMpcStateDim, NU, CostTerms>;
  using X = typename Base::X;
  using U = typename Base::U;
  using Expansion = typename Base::Expansion;

  /// @param inner  must outlive this
  FloorLimitedContinuousProblem(const RobotParameters& robot, const Constraints& constraints,
                                ContinuousProblem<NU>& inner)
      : inner_(inner), constraints_(constraints), spin_torque_(robot) {}

  /// @param torque  that the floor holds; kUnlimited without end [N m]
  void setHeld(double torque) noexcept { constraints_.takeFloor(torque); }
  bool isLimited() const noexcept { return constraints_.spin_torque_limit < kUnlimited; }

  void setTime(double t) noexcept override { inner_.setTime(t); }
  void flow(const X& x, const U& u, X& dx) const noexcept override { inner_.flow(x, u, dx); }
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
  Constraints constraints_;
  SpinTorque spin_torque_;
};

}  // namespace ballbot
