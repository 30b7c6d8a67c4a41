#pragma once

#include <vector>

#include "controller/lasting_force.hpp"
#include "controller/push_belief.hpp"
#include "estimator/estimator.hpp"
#include "model/added_signals.hpp"

namespace ballbot {

/// What a controller knows beside the robot's state.
struct BesideEstimate {
  const StateEstimate& estimate;
  double floor_held;  ///< counted on [N m]
  const LastingForce& lasting;
  const PushEstimate& push;
};

/// One of its values that goes on record beside an estimate.
struct BesideSignal {
  AddedSignal signal;
  double (*value)(const BesideEstimate& known, int index);
  int index = 0;
};

/// Those of a controller, in their order on record.
/// @param spin  the estimator knows the ball's spin
std::vector<BesideSignal> besideEstimate(bool spin, bool lasting_forces, bool pushes);

}  // namespace ballbot
