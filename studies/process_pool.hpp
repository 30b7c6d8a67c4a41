#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace ballbot {

/// How a task of runInProcesses() ended.
struct TaskEnd {
  enum class Kind { kDone, kCrashed, kTimedOut };
  Kind kind = Kind::kDone;
  std::string answer;   ///< what the task returned, if it is done
  std::string trouble;  ///< how it ended otherwise, in words, with its last words on stderr
};

/// How many processors this process may use.
int processorCount();

struct PoolOptions {
  int jobs = 1;                                ///< tasks at once
  std::chrono::milliseconds timeout{600'000};  ///< wall-clock time one task may take
  const std::atomic<bool>* stop = nullptr;     ///< set by Ctrl-C
};

/// Calls `task(i)` for i = 0 .. count-1, each in a process of its own that is a copy of this one
/// (fork without exec), so that whatever was read before is shared and nothing a task does can harm
/// another. `ended(i, end)` is called here, in the order in which tasks end. Should this process
/// die, its tasks die with it.
///
/// The calling process must have no other thread.
/// @throw InterruptedError once `stop` is set; every task has been ended by then.
void runInProcesses(std::size_t count, const std::function<std::string(std::size_t)>& task,
                    const PoolOptions& options,
                    const std::function<void(std::size_t, const TaskEnd&)>& ended);

}  // namespace ballbot
