#include "controller/resting_schedule.hpp"

namespace ballbot {

TaskSchedule restingSchedule(const RobotParameters& robot, const TaskSchedule& schedule, double t) {
  TaskSchedule out(robot);
#define BALLBOT_WEIGHT(name, N, unit, term, least, words) \
  out.name##_weight = TimedWeight<N>(schedule.name##_weight.value(t));
  BALLBOT_TASKS(BALLBOT_WEIGHT, BALLBOT_WEIGHT)
#undef BALLBOT_WEIGHT
  out.contact_force_weight = TimedWeight<3>();
  out.contact_moment_weight = TimedWeight<3>();
  out.added = schedule.added;
  return out;
}

}  // namespace ballbot
