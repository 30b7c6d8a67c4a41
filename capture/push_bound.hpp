#pragma once

#include <limits>

#include "capture/balance_model.hpp"

namespace ballbot {

/// What no controller gets past; infinite: no such limit.
struct BalanceLimits {
  double wheel_torque = 0;    ///< of each wheel, either way [N m]
  double wheel_speed = 0;     ///< of each wheel relative to the base [rad/s]
  double tilt = 0;            ///< of the base against the vertical [rad]
  double floor_friction = 0;  ///< horizontal force over weight, at the floor
  double wheel_friction =
      std::numeric_limits<double>::infinity();  ///< traction over normal force, at each wheel
};

/// How a push is met.
struct PushTimes {
  double duration_s = 0.5;  ///< of the force, constant from 0 on
  double blind_s = 0;       ///< from its onset: nothing is done yet, for nobody knows of it
  double recovery_s = 3;    ///< from its end until all is at rest and upright again, anywhere
  double step_s = 0.02;     ///< torques change so often at most
};

/// The largest force along a horizontal direction from which there is a way back to rest for the
/// robot of `model`, which stands at rest until the force sets in, when whoever moves the wheels
/// knows the whole push: a linear program over the torques. No law that keeps to the arm's pose
/// does better as far as the model is true: to first order, with the arm held still. Arms that
/// swing, and angles that are not small, are outside of it.
///
/// Limits on tilt and friction are polygons around their circles, so that none is tighter than it
/// is.
/// @param direction_rad  of the force, from x of W towards y
/// @return [N]
/// @throw NumericalError if the push is bounded by none of the limits.
double largestPush(const BalanceModel& model, const BalanceLimits& limits, const PushTimes& times,
                   double direction_rad);

}  // namespace ballbot
