#pragma once

#include "model/state.hpp"

namespace ballbot {

/// Forces on the robot that come from outside the simulated world: from whoever imports the plant,
/// or from another model coupled to it. Held until they are set anew; in W, constant there.
struct ExternalForces {
  Vector3 base_force_W = Vector3::Zero();          ///< on the base [N]
  Vector3 base_point_B = Vector3::Zero();          ///< where, from K in the base frame [m]
  Vector3 end_effector_force_W = Vector3::Zero();  ///< on the last link at E [N]

  Vector3 sum() const { return base_force_W + end_effector_force_W; }
};

}  // namespace ballbot
