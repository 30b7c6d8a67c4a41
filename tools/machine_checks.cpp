#include "tools/machine_checks.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "core/error.hpp"
#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"

namespace ballbot {
namespace {

using Level = MachineCheck::Level;

/// Sends one message and waits for it to come back, over a network as a run uses it.
MachineCheck multicast() {
  MachineCheck check{"multicast", Level::kBroken, "", kMulticastRemedy};
  const std::string url = privateLcmAddress().url;
  try {
    LcmBus bus(url);
    bus.subscribe("DOCTOR");
    const std::uint8_t byte = 'b';
    const LcmBus::Message* message = nullptr;
    if (!bus.publish("DOCTOR", &byte, 1)) {
      check.found = fmt::format("cannot send to {}: {}", url, std::strerror(errno));
    } else if (!bus.receive(message, std::chrono::milliseconds(500))) {
      check.found = fmt::format("a message to {} did not come back within 500 ms", url);
    } else {
      return {"multicast", Level::kOk, fmt::format("messages to {} come back", url), ""};
    }
  } catch (const Error& error) {
    check.found = error.what();
  }
  return check;
}

MachineCheck receiveBuffer() {
  std::ifstream in("/proc/sys/net/core/rmem_max");
  long bytes = 0;
  in >> bytes;
  constexpr long kWanted = 2 << 20;
  MachineCheck check{"receive buffer", Level::kOk,
                     fmt::format("net.core.rmem_max is {} kB", bytes / 1024), ""};
  if (bytes < kWanted) {
    check.level = Level::kWarning;
    check.found += "; a listener that lags may lose packets (they are sent again, so results hold)";
    check.mend = fmt::format("sysctl -w net.core.rmem_max={}", kWanted);
  }
  return check;
}

MachineCheck processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  ::sched_getaffinity(0, sizeof set, &set);
  const int count = CPU_COUNT(&set);
  MachineCheck check{"processors", Level::kOk,
                     fmt::format("{} usable, pinning to one works", count), ""};
  const int core = [&] {
    for (int i = 0; i < CPU_SETSIZE; ++i) {
      if (CPU_ISSET(i, &set)) return i;
    }
    return 0;
  }();
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  if (::sched_setaffinity(0, sizeof one, &one) != 0) {
    check.level = Level::kWarning;
    check.found =
        fmt::format("{} usable, but pinning is refused: {}; runs are slower, not different", count,
                    std::strerror(errno));
    check.mend = "ballbot run --no-pin SCENARIO";
  }
  ::sched_setaffinity(0, sizeof set, &set);
  return check;
}

MachineCheck realTime() {
  rlimit limit{};
  ::getrlimit(RLIMIT_RTPRIO, &limit);
  const bool root = ::geteuid() == 0;
  if (root || limit.rlim_cur >= 50) {
    return {"real-time rights", Level::kOk,
            root ? "running as root" : fmt::format("priorities up to {} allowed", limit.rlim_cur),
            ""};
  }
  return {
      "real-time rights", Level::kWarning,
      fmt::format("priority limit is {}; only a bench with real drives needs more", limit.rlim_cur),
      "echo '@realtime - rtprio 98' | sudo tee /etc/security/limits.d/ballbot.conf && sudo usermod "
      "-aG "
      "realtime $USER"};
}

MachineCheck lockedMemory() {
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  if (::geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= (256UL << 20)) {
    return {"locked memory", Level::kOk, "the bench may lock its memory", ""};
  }
  return {"locked memory", Level::kWarning,
          fmt::format("limit is {} kB; only a bench with real drives needs more",
                      limit.rlim_cur / 1024),
          "echo '@realtime - memlock unlimited' | sudo tee -a /etc/security/limits.d/ballbot.conf"};
}

MachineCheck diskSpace() {
  struct statvfs disk {};
  if (::statvfs(".", &disk) != 0) {
    return {"disk space", Level::kWarning, fmt::format("cannot be read: {}", std::strerror(errno)),
            ""};
  }
  const double free_MB =
      static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) * 1e-6;
  MachineCheck check{"disk space", Level::kOk, fmt::format("{:.0f} MB free here", free_MB), ""};
  if (free_MB < 500) {
    check.level = Level::kWarning;
    check.found += "; a run needs up to 2 MB per simulated second";
    check.mend = "ballbot run --out DIR SCENARIO, with DIR on a larger disk";
  }
  return check;
}

}  // namespace

std::vector<MachineCheck> checkMachine() {
  return {multicast(), receiveBuffer(), processors(), realTime(), lockedMemory(), diskSpace()};
}

}  // namespace ballbot
