#include "hil/rehearsal/lockstep_clock.hpp"

#include <algorithm>
#include <chrono>

namespace ballbot {
namespace {

constexpr int kSleepsPerCycle = 2;
constexpr std::chrono::milliseconds kMoment{2};

}  // namespace

std::int64_t LockstepClock::now() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  return now_;
}

void LockstepClock::sleepUntil(std::int64_t time_ns) noexcept {
  std::unique_lock<std::mutex> lock(mutex_);
  asleep_ = true;
  wake_at_ = time_ns;
  changed_.notify_all();
  changed_.wait(lock, [this] { return allowed_ > 0 || free_; });
  if (allowed_ > 0) --allowed_;
  asleep_ = false;
  now_ = std::max(now_, time_ns);
}

bool LockstepClock::loopWaits() {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, kMoment, [this] { return asleep_ && allowed_ == 0; });
}

void LockstepClock::runCycle() {
  std::unique_lock<std::mutex> lock(mutex_);
  allowed_ += kSleepsPerCycle;
  changed_.notify_all();
  changed_.wait(lock, [this] { return (asleep_ && allowed_ == 0) || free_; });
}

void LockstepClock::oversleep(std::int64_t ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  now_ = wake_at_ + ns;
}

void LockstepClock::letGo() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  free_ = true;
  changed_.notify_all();
}

}  // namespace ballbot
