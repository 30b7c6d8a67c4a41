#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace ballbot {

/// Number of a task in its calendar; tasks due at one instant run in this order.
using TaskId = std::size_t;

/// The tasks due at one instant.
class DueTasks {
 public:
  DueTasks() = default;
  bool has(TaskId task) const noexcept { return (bits_ >> task & 1U) != 0; }
  bool none() const noexcept { return bits_ == 0; }
  void add(TaskId task) noexcept { bits_ |= std::uint64_t{1} << task; }

 private:
  std::uint64_t bits_ = 0;
};

/// When each periodic task of a run is due, in whole nanoseconds. A pure function of time: nothing
/// is stored between events, so save and restore need no entry for it.
class EventCalendar {
 public:
  static constexpr SimDuration kDefaultBaseStep{100'000};  // 100 us
  static constexpr std::size_t kMaxTasks = 64;

  /// @throw InputError if the base step is not positive.
  explicit EventCalendar(SimDuration base_step = kDefaultBaseStep);

  /// A task due at offset, offset + period, offset + 2 period, ...
  /// @param where what a message begins with instead of "NAME ", e.g. ConfigReader::at(key)
  /// @throw InputError if period or offset is not a whole multiple of the base step, the period is
  ///        not positive or the offset negative; the text names the nearest that would do.
  TaskId addTask(const std::string& name, SimDuration period, SimDuration offset = {},
                 const std::string& where = "");

  SimDuration baseStep() const { return base_step_; }
  std::size_t taskCount() const { return tasks_.size(); }
  const std::string& name(TaskId task) const { return tasks_.at(task).name; }
  SimDuration period(TaskId task) const { return tasks_.at(task).period; }
  /// @throw InputError if there is no such task.
  TaskId find(const std::string& name) const;

  DueTasks dueAt(SimTime t) const noexcept;
  /// The first instant after `t` at which a task is due; SimTime::max() without tasks.
  SimTime nextAfter(SimTime t) const noexcept;

 private:
  struct Task {
    std::string name;
    SimDuration period, offset;
  };
  SimDuration base_step_;
  std::vector<Task> tasks_;
};

/// @throw InputError "WHAT 3.3 ms is not a whole multiple of the base step 500 us. Nearest: 3 ms,
///        3.5 ms"; a `duration` that is not positive counts as none.
void requireWholeMultiple(SimDuration duration, SimDuration base_step, const std::string& what);

}  // namespace ballbot
