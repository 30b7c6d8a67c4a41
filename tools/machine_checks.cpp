#include "tools/machine_checks.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

namespace ballbot {
namespace {

using Level = MachineCheck::Level;

/// A socket that closes itself.
struct Socket {
  int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  ~Socket() {
    if (fd >= 0) ::close(fd);
  }
};

/// Sends one datagram to a multicast group with ttl 0 and waits for it to come back, as LCM does.
MachineCheck multicast() {
  MachineCheck check{"multicast", Level::kBroken, "", ""};
  check.mend = "ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo";
  Socket receiver, sender;
  const int one = 1;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  ::setsockopt(receiver.fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
  if (::bind(receiver.fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    check.found = fmt::format("cannot bind a UDP port: {}", std::strerror(errno));
    return check;
  }
  socklen_t size = sizeof address;
  ::getsockname(receiver.fd, reinterpret_cast<sockaddr*>(&address), &size);
  ip_mreq group{};
  group.imr_multiaddr.s_addr = inet_addr("239.255.76.67");
  group.imr_interface.s_addr = htonl(INADDR_ANY);
  if (::setsockopt(receiver.fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) != 0) {
    check.found = fmt::format("cannot join 239.255.76.67: {}", std::strerror(errno));
    return check;
  }
  const unsigned char ttl = 0;
  ::setsockopt(sender.fd, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  address.sin_addr = group.imr_multiaddr;
  const char byte = 'b';
  if (::sendto(sender.fd, &byte, 1, 0, reinterpret_cast<sockaddr*>(&address), sizeof address) != 1) {
    check.found = fmt::format("cannot send to 239.255.76.67: {}", std::strerror(errno));
    return check;
  }
  pollfd wait{receiver.fd, POLLIN, 0};
  if (::poll(&wait, 1, 500) != 1) {
    check.found = "a datagram to 239.255.76.67 did not come back within 500 ms";
    return check;
  }
  return {"multicast", Level::kOk, "datagrams to 239.255.76.67 come back (ttl 0: they stay on this machine)", ""};
}

MachineCheck receiveBuffer() {
  std::ifstream in("/proc/sys/net/core/rmem_max");
  long bytes = 0;
  in >> bytes;
  constexpr long kWanted = 2 << 20;
  MachineCheck check{"receive buffer", Level::kOk, fmt::format("net.core.rmem_max is {} kB", bytes / 1024), ""};
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
  MachineCheck check{"processors", Level::kOk, fmt::format("{} usable, pinning to one works", count), ""};
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
    check.found = fmt::format("{} usable, but pinning is refused: {}; runs are slower, not different", count,
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
            root ? "running as root" : fmt::format("priorities up to {} allowed", limit.rlim_cur), ""};
  }
  return {"real-time rights", Level::kWarning,
          fmt::format("priority limit is {}; only a bench with real drives needs more", limit.rlim_cur),
          "echo '@realtime - rtprio 98' | sudo tee /etc/security/limits.d/ballbot.conf && sudo usermod -aG "
          "realtime $USER"};
}

MachineCheck lockedMemory() {
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  if (::geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= (256UL << 20)) {
    return {"locked memory", Level::kOk, "the bench may lock its memory", ""};
  }
  return {"locked memory", Level::kWarning,
          fmt::format("limit is {} kB; only a bench with real drives needs more", limit.rlim_cur / 1024),
          "echo '@realtime - memlock unlimited' | sudo tee -a /etc/security/limits.d/ballbot.conf"};
}

MachineCheck diskSpace() {
  struct statvfs disk {};
  if (::statvfs(".", &disk) != 0) {
    return {"disk space", Level::kWarning, fmt::format("cannot be read: {}", std::strerror(errno)), ""};
  }
  const double free_MB = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) * 1e-6;
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
