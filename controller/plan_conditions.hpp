#pragma once

#include <optional>

#include "controller/lasting_load.hpp"
#include "controller/pushed_problem.hpp"
#include "model/limits.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

/// What an engine's plans count on: Circumstances as they are to a robot in one state.
struct PlanConditions {
  /// Torque with which the floor holds the ball's spin; kUnlimited without end [N m].
  double floor_held = kUnlimited;
  WheelFlags lost_wheels{};       ///< whose torque moves nothing
  std::optional<double> payload;  ///< in the hand; without it, what the robot's parameters say [kg]
  LastingLoad load;
  Push push;
};

}  // namespace ballbot
