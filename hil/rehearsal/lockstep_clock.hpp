#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "hil/loop_clock.hpp"

namespace ballbot {

/// A clock for a real-time loop that runs one cycle when it is told to, and no time between: the
/// same on any machine. The loop sleeps twice in a cycle, before SYNC and before it acts.
class LockstepClock final : public LoopClock {
 public:
  std::int64_t now() noexcept override;
  void sleepUntil(std::int64_t time_ns) noexcept override;
  RealtimeGrant prepareThread(int) override { return {false, false, "in lockstep"}; }
  void leaveThread() noexcept override { letGo(); }

  /// Waits until the loop sleeps before a cycle. False if none does within a moment.
  bool loopWaits();
  /// Lets the loop run one whole cycle and waits for its end.
  void runCycle();
  /// The loop, asleep before a cycle, wakes so much too late.
  void oversleep(std::int64_t ns);
  /// From now on the loop runs by itself, so that it can end.
  void letGo() noexcept;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t now_ = 0, wake_at_ = 0;
  int allowed_ = 0;  ///< sleeps that may end
  bool asleep_ = false, free_ = false;
};

}  // namespace ballbot
