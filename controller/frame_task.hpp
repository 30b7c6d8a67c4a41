#pragma once

#include <vector>

#include "controller/added_task.hpp"
#include "model/frame_kinematics.hpp"

namespace ballbot {

/// A list of frames of the robot, of each of which position, orientation or both are asked for: the
/// tasks that Minniti et al. 2019, section III-B, have for every rigid body. The tasks that are
/// read are appended.
void describeFrameTasks(ConfigVisitor& v, const RobotParameters& robot, const StateVector& rest,
                        std::vector<std::shared_ptr<const AddedTask>>& tasks);

}  // namespace ballbot
