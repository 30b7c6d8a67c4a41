#pragma once

#include <vector>

#include "controller/continuous_problem.hpp"
#include "controller/lasting_load.hpp"
#include "controller/whole_body_problem.hpp"
#include "controller/wrapped_problem.hpp"

namespace ballbot {

/// A problem of a robot on which a force acts that lasts: its acceleration is part of the motion,
/// and the wheels' torques cost as much as they differ from those without it by what it takes to
/// stand still. (The arm's are counted from there anyway: Tasks::arm_torque.)
template <int NU>
class DisturbedProblem final : public WrappedProblem<NU> {
 public:
  using typename WrappedProblem<NU>::Base;
  using typename WrappedProblem<NU>::X;
  using typename WrappedProblem<NU>::U;
  using typename WrappedProblem<NU>::Stage;

  /// @param whole_body  whose tasks say what torques cost, and the first inner one; must outlive
  ///                    this
  /// @param knots  of its horizon [s]
  DisturbedProblem(const FrequencyShaping& shaping, const std::vector<double>& knots,
                   WholeBodyProblem<NU>& whole_body);

  void setLoad(const LastingLoad& load) noexcept { load_ = load; }
  bool isLoaded() const noexcept { return load_.acts; }

  void step(int k, const X& x, const U& u, X& next) const noexcept override;
  void addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept override;
  void approximate(int first, int count, const X* x, const U* u, CostTerms* terms,
                   Stage* lq) const noexcept override;

 private:
  /// What torques cost more for being meant about the load's.
  void addTorqueCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept;

  WholeBodyProblem<NU>& whole_body_;
  std::vector<FilterStep> steps_;  ///< one per stage
  LastingLoad load_;
};

/// The same in continuous time.
template <int NU>
class DisturbedContinuousProblem final : public WrappedContinuousProblem<NU> {
 public:
  using typename WrappedContinuousProblem<NU>::Base;
  using typename WrappedContinuousProblem<NU>::X;
  using typename WrappedContinuousProblem<NU>::U;
  using typename WrappedContinuousProblem<NU>::Expansion;

  DisturbedContinuousProblem(const FrequencyShaping& shaping, ContinuousProblem<NU>& whole_body)
      : WrappedContinuousProblem<NU>(whole_body), shaping_(shaping), whole_body_(whole_body) {}

  void setLoad(const LastingLoad& load) noexcept { load_ = load; }
  bool isLoaded() const noexcept { return load_.acts; }

  void flow(const X& x, const U& u, X& dx) const noexcept override;
  void addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept override;
  void expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept override;

 private:
  FrequencyShaping shaping_;
  ContinuousProblem<NU>& whole_body_;
  LastingLoad load_;
};

}  // namespace ballbot
