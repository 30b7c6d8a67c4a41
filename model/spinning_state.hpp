#pragma once

#include "model/state.hpp"

namespace ballbot {

// The state of a robot whose ball may spin about the vertical: a ninth velocity comes last, the z
// of the ball's angular velocity in W [rad/s]. How far it has turned is followed by nothing, for
// the ball is isotropic.
//
//   x = (q, nu, spin),   w_WK_W = (-vy/r, vx/r, spin)

constexpr int kBallSpin = kVelocityDim;
constexpr int kSpinningVelocityDim = kVelocityDim + 1;
constexpr int kSpinningStateDim = kPositionDim + kSpinningVelocityDim;

using SpinningVelocityVector = Eigen::Matrix<double, kSpinningVelocityDim, 1>;  ///< (nu, spin)
using SpinningStateVector = Eigen::Matrix<double, kSpinningStateDim, 1>;        ///< (q, nu, spin)

}  // namespace ballbot
