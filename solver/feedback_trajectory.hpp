#pragma once

#include <vector>

#include <Eigen/Core>

#include "solver/riccati.hpp"

namespace ballbot {

/// Trajectory with feedback: u = u_k + K_k (x - x_k). k() of the gains is not part of it.
template <int NX, int NU>
struct FeedbackTrajectory {
  std::vector<Eigen::Matrix<double, NX, 1>> x;  ///< N + 1
  std::vector<Eigen::Matrix<double, NU, 1>> u;  ///< N in discrete time, N + 1 in continuous time
  std::vector<StageGain<NX, NU>> gain;          ///< as many as u

  /// Makes it as long, and zero.
  void reset(int states, int controls) {
    x.assign(states, Eigen::Matrix<double, NX, 1>::Zero());
    u.assign(controls, Eigen::Matrix<double, NU, 1>::Zero());
    gain.assign(controls, StageGain<NX, NU>());
  }
};

}  // namespace ballbot
