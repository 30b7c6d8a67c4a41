#include "hil/realtime_thread.hpp"

#include <cerrno>
#include <cstring>
#include <ctime>

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace ballbot {

RealtimeGrant becomeRealtime(int priority) {
  RealtimeGrant grant;
  grant.locked_memory = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  const int lock_error = errno;
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
  grant.fifo = error == 0;
  grant.text = grant.fifo ? fmt::format("SCHED_FIFO {}", priority)
                          : fmt::format(
                                "no SCHED_FIFO ({}; give the user rtprio in "
                                "/etc/security/limits.conf, or LimitRTPRIO= in the unit)",
                                std::strerror(error));
  grant.text += grant.locked_memory ? ", memory locked"
                                    : fmt::format(", memory not locked ({}; raise memlock)",
                                                  std::strerror(lock_error));
  return grant;
}

std::int64_t monotonicNs() noexcept {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

void sleepUntilNs(std::int64_t time_ns) noexcept {
  const timespec t{time_ns / 1'000'000'000, time_ns % 1'000'000'000};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

}  // namespace ballbot
