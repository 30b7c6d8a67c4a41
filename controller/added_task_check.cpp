// In a file of its own: what stands beside the code of a plan can change its last bits.
#include "controller/added_task_check.hpp"

#include <limits>

#include "core/error.hpp"

namespace ballbot {
namespace {

bool isFinite(const AddedTask& task, const StateVector& x, const TaskTarget& target) noexcept {
  Vector3 e = Vector3::Zero();
  TaskJacobian J = TaskJacobian::Zero();
  task.residual(x, target.reference, e, &J);
  return e.allFinite() && J.allFinite();
}

}  // namespace

void requireFinite(const AddedTask& task, const StateVector& rest, const std::string& where) {
  TaskTarget target;
  task.at(0, 0, target);
  if (target.weight.isZero(0) || isFinite(task, rest, target)) return;
  throw InputError(where + ": the residual of this task, or its derivative, is not finite with " +
                   "the robot at rest");
}

void markNotFinite(const TaskSchedule& schedule, double now, const StateVector& x,
                   CostTerms& terms) noexcept {
  for (std::size_t i = 0; i < schedule.added.size(); ++i) {
    TaskTarget target;
    schedule.added[i]->at(now, now, target);
    if (!target.weight.isZero(0) && !isFinite(*schedule.added[i], x, target)) {
      terms.added[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace ballbot
