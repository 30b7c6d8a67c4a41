#pragma once

#include <vector>

#include <Eigen/Core>

#include "solver/between_samples.hpp"
#include "solver/feedback_trajectory.hpp"

namespace ballbot {

/// A solution that is read by time: u(t) = u_ff(t) + K(t) (x - x_ff(t)), linear between its
/// samples, constant outside. States belong to the knots. Inputs and gains belong to times of their
/// own: an input held over a step stands in the step's middle, because interpolating it between
/// knots would lag by half a step. Only the constructor allocates.
template <int NX, int NU>
class SampledPolicy {
 public:
  using X = Eigen::Matrix<double, NX, 1>;
  using U = Eigen::Matrix<double, NU, 1>;
  using Gain = Eigen::Matrix<double, NU, NX>;

  /// All zero. Times rise, from whatever instant the policy counts from [s].
  SampledPolicy(const std::vector<double>& knots, const std::vector<double>& control_times)
      : states_(knots.size()), controls_(control_times.size()) {
    for (std::size_t k = 0; k < knots.size(); ++k) states_[k] = {knots[k], X::Zero()};
    for (std::size_t k = 0; k < control_times.size(); ++k) {
      controls_[k] = {control_times[k], U::Zero(), Gain::Zero()};
    }
  }

  /// @param trajectory  of as many states and inputs
  void set(const FeedbackTrajectory<NX, NU>& trajectory) noexcept {
    for (std::size_t k = 0; k < states_.size(); ++k) states_[k].x = trajectory.x[k];
    for (std::size_t k = 0; k < controls_.size(); ++k) {
      controls_[k].u = trajectory.u[k];
      controls_[k].K = trajectory.gain[k].K();
    }
  }

  X stateAt(double t) const noexcept { return BetweenSamples<State>(states_, t).of(&State::x); }
  /// @param K  a Gain, or a view of one
  template <typename Matrix>
  void controlAt(double t, U& u, Matrix&& K) const noexcept {
    const BetweenSamples<Control> between(controls_, t);
    u = between.of(&Control::u);
    K = between.of(&Control::K);
  }
  /// What to do at time t in state x.
  U input(double t, const X& x) const noexcept {
    U u;
    Gain K;
    controlAt(t, u, K);
    return u + K * (x - stateAt(t));
  }

 private:
  struct State {
    double time;
    X x;
  };
  struct Control {
    double time;
    U u;
    Gain K;
  };
  std::vector<State> states_;
  std::vector<Control> controls_;
};

}  // namespace ballbot
