#include "model/dynamics_constants.hpp"
#include "model/reduced_dynamics.hpp"

// In a file of its own: what stands beside the dynamics' code can change how that is compiled.

namespace ballbot {

void ReducedDynamics::setPayload(double mass) noexcept {
  robot_.payload_mass = mass;
  *constants_ = DynamicsConstants(robot_);
}

}  // namespace ballbot
