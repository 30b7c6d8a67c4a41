#pragma once

#include "core/config_visitor.hpp"
#include "model/limits.hpp"

namespace ballbot {

/// The key of the `controller:` section that says what the floor is believed to hold against a spin
/// of the ball about the vertical [N m].
inline void describeFloor(ConfigVisitor& v, double& spin_torque) {
  v.number(may("floor_spin_torque_Nm",
               "torque about the vertical that the floor under the ball is counted on to hold "
               "before the ball spins; plan and tracker stay within a share of it"),
           spin_torque, {0.05, kInf});
}

}  // namespace ballbot
