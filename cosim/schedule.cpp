#include "cosim/schedule.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

void requireWholeMultiple(SimDuration duration, SimDuration base_step, const std::string& what) {
  if (duration.count() > 0 && duration.count() % base_step.count() == 0) return;
  const SimDuration below{duration.count() / base_step.count() * base_step.count()};
  const std::string nearest = below.count() > 0
                                  ? fmt::format("{}, {}", toText(below), toText(below + base_step))
                                  : toText(base_step);
  throw InputError(fmt::format("{} {} is not a whole multiple of the base step {}. Nearest: {}",
                               what, toText(duration), toText(base_step), nearest));
}

EventCalendar::EventCalendar(SimDuration base_step) : base_step_(base_step) {
  if (base_step.count() <= 0) {
    throw InputError(fmt::format("base step is {}, must be above 0", toText(base_step)));
  }
}

TaskId EventCalendar::addTask(const std::string& name, SimDuration period, SimDuration offset,
                              const std::string& where) {
  if (tasks_.size() == kMaxTasks) {
    throw InputError(fmt::format("task {} is one too many, a calendar holds {}", name, kMaxTasks));
  }
  requireWholeMultiple(period, base_step_, where.empty() ? name + " period" : where);
  if (offset.count() < 0) {
    throw InputError(fmt::format("{} offset is {}, must not be negative", name, toText(offset)));
  }
  if (offset.count() > 0) requireWholeMultiple(offset, base_step_, name + " offset");
  tasks_.push_back({name, period, offset});
  return tasks_.size() - 1;
}

TaskId EventCalendar::find(const std::string& name) const {
  for (TaskId id = 0; id < tasks_.size(); ++id) {
    if (tasks_[id].name == name) return id;
  }
  std::string known;
  for (const Task& task : tasks_) known += (known.empty() ? "" : ", ") + task.name;
  throw InputError(fmt::format("no task '{}' in the calendar; there are: {}", name, known));
}

DueTasks EventCalendar::dueAt(SimTime t) const noexcept {
  DueTasks due;
  for (TaskId id = 0; id < tasks_.size(); ++id) {
    const SimDuration since = t.time_since_epoch() - tasks_[id].offset;
    if (since.count() >= 0 && since.count() % tasks_[id].period.count() == 0) due.add(id);
  }
  return due;
}

SimTime EventCalendar::nextAfter(SimTime t) const noexcept {
  SimTime next = SimTime::max();
  for (const Task& task : tasks_) {
    const std::int64_t since = toNs(t) - task.offset.count();
    const std::int64_t periods = since < 0 ? 0 : since / task.period.count() + 1;
    next = std::min(next, SimTime{task.offset + periods * task.period});
  }
  return next;
}

}  // namespace ballbot
