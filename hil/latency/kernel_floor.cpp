#include "hil/latency/kernel_floor.hpp"

#include <algorithm>
#include <chrono>

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include "hil/deadline_schedule.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kLeadNs = 2'000'000;  // from starting the thread to its first deadline
constexpr std::chrono::milliseconds kLook{20};

/// Tells the kernel that no latency beyond 0 us is borne: no idle state deeper than polling, as
/// long as it lives. -1 where that is not allowed.
int holdCpuAwake() {
  const int fd = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  if (fd < 0) return -1;
  const std::int32_t us = 0;
  if (::write(fd, &us, sizeof us) == sizeof us) return fd;
  ::close(fd);
  return -1;
}

}  // namespace

KernelFloor::KernelFloor(const FloorSettings& settings) {
  result_.period_ns = settings.period_ns;
  thread_ = std::thread([this, settings] { run(settings); });
}

KernelFloor::~KernelFloor() { finish(); }

const KernelFloor::Result& KernelFloor::finish() noexcept {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  return result_;
}

void KernelFloor::run(FloorSettings settings) noexcept {
  if (settings.core >= 0) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(settings.core), &one);
    ::pthread_setaffinity_np(::pthread_self(), sizeof one, &one);
  }
  const int awake = settings.hold_cpu_awake ? holdCpuAwake() : -1;
  result_.held_awake = awake >= 0;
  if (settings.realtime) result_.grant = becomeRealtime(settings.priority);
  DeadlineSchedule schedule(monotonicNs() + kLeadNs, settings.period_ns);
  while (!stop_) {
    sleepUntilNs(schedule.deadline());
    const std::int64_t now = monotonicNs();
    result_.late.add(now - schedule.deadline());
    schedule.advance(now);
  }
  if (awake >= 0) ::close(awake);
}

KernelFloor::Result measureFloor(const FloorSettings& settings, double seconds,
                                 const std::atomic<bool>* stop) {
  using Clock = std::chrono::steady_clock;
  KernelFloor floor(settings);
  const auto length = std::chrono::duration<double>(seconds);
  const Clock::time_point until =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(length);
  for (auto now = Clock::now(); now < until && !(stop != nullptr && *stop); now = Clock::now()) {
    std::this_thread::sleep_for(std::min<Clock::duration>(kLook, until - now));
  }
  floor.finish();
  // Its thread has locked all memory of this process, and what is yet to come; a bench locks its
  // own.
  ::munlockall();
  return floor.finish();
}

}  // namespace ballbot
