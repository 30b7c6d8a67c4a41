#pragma once

#include "core/time.hpp"
#include "estimator/filter_state.hpp"

namespace ballbot {

/// Brings ball and base forward by `ahead`: the base keeps turning at w, the ball keeps its
/// acceleration. Over a few milliseconds that is all the sensors can say; longer delays are the
/// business of a controller that knows its torques. The arm's entries of the result are zero.
/// @param accel_W of the ball centre [m/s^2], @param yaw continuous, of `x` [rad]
/// Free of allocation; for the control step.
StateVector bringForward(const FilterState& x, const Eigen::Vector2d& accel_W, double yaw,
                         SimDuration ahead) noexcept;

}  // namespace ballbot
