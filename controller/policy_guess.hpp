#pragma once

#include "controller/mpc_policy.hpp"
#include "solver/feedback_trajectory.hpp"

namespace ballbot {

/// A plan as a solver with NU inputs reads it by time: plans have rows for all inputs.
template <int NU>
class PolicyGuess {
 public:
  explicit PolicyGuess(const MpcPolicy& policy) : policy_(policy) {}

  MpcState stateAt(double t) const noexcept { return policy_.stateAt(t); }
  template <typename Gain>
  void controlAt(double t, Eigen::Matrix<double, NU, 1>& u, Gain&& K) const noexcept {
    MpcInput all;
    MpcGain gain;
    policy_.controlAt(t, all, gain);
    u = all.template head<NU>();
    K = gain.template topRows<NU>();
  }

 private:
  const MpcPolicy& policy_;
};

/// Writes a solution into a plan of as many states and inputs, which thereby is valid from `now`
/// on.
template <int NU>
void setPolicy(const FeedbackTrajectory<kMpcStateDim, NU>& solution, SimTime now,
               MpcPolicy& out) noexcept {
  for (std::size_t k = 0; k < solution.x.size(); ++k) out.knots()[k].x = solution.x[k];
  for (std::size_t k = 0; k < solution.u.size(); ++k) {
    out.controls()[k].u.template head<NU>() = solution.u[k];
    out.controls()[k].K.template topRows<NU>() = solution.gain[k].K();
  }
  out.setValid(now);
}

}  // namespace ballbot
