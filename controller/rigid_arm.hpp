#pragma once

#include "model/robot_parameters.hpp"

namespace ballbot {

/// The robot as someone sees it who knows nothing of its arm but what it weighs, payload included,
/// when it stands still at `arm` [rad]: the links are part of the base. Base and ball move exactly
/// as those of the whole robot whose arm is held there.
///
/// The three arm joints remain as coordinates, so that everything made for the whole robot fits,
/// but they carry nothing, and what carries nothing is rigid to the dynamics: no torque moves them,
/// and none of theirs reaches the base.
RobotParameters withRigidArm(const RobotParameters& robot, const ArmVector& arm);

}  // namespace ballbot
