#pragma once

#include "model/robot_parameters.hpp"

namespace ballbot {

/// The robot as someone sees it who knows nothing of its arm but what it weighs, payload included,
/// when it stands still at `arm` [rad]: the links are part of the base. Base and ball accelerate
/// exactly as those of the whole robot whose arm is held there.
///
/// The three arm joints remain, so that everything made for the whole robot fits, but what they
/// turn has next to no mass and an inertia about its own axis only: they neither feel the base nor
/// move it at rest.
RobotParameters withFrozenArm(const RobotParameters& robot, const Vector3& arm);

}  // namespace ballbot
