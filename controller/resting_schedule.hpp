#pragma once

#include "controller/tasks.hpp"

namespace ballbot {

/// The tasks of one instant for good: their weights are those of `schedule` at time t [s], and what
/// has a reference is asked for where the robot stands at rest at the origin, without contact.
/// Tasks that were added keep their own references.
TaskSchedule restingSchedule(const RobotParameters& robot, const TaskSchedule& schedule, double t);

}  // namespace ballbot
