#include "cosim/lcm_bus.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <random>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr const char* kUdpm = "udpm://";

struct Socket {
  Socket() : fd(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() { ::close(fd); }
  int fd;
};

sockaddr_in parseUdpm(const std::string& url) {
  const auto unusable = [&](const std::string& why) {
    return InputError(
        fmt::format("LCM URL '{}': {}. Try: udpm://239.255.76.67:7667?ttl=0", url, why));
  };
  const std::size_t begin = std::strlen(kUdpm);
  const std::string host_port = url.substr(begin, url.find('?') - begin);
  const std::size_t colon = host_port.find(':');
  if (colon == std::string::npos) throw unusable("no port");
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (inet_aton(host_port.substr(0, colon).c_str(), &address.sin_addr) == 0) {
    throw unusable(fmt::format("'{}' is no IPv4 address", host_port.substr(0, colon)));
  }
  if (!IN_MULTICAST(ntohl(address.sin_addr.s_addr))) {
    throw unusable("not a multicast address (224.0.0.0 to 239.255.255.255)");
  }
  char* end = nullptr;
  const long port = std::strtol(host_port.c_str() + colon + 1, &end, 10);
  if (*end != '\0' || port < 1 || port > 65535) throw unusable("the port must be 1 to 65535");
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

// LCM would say this on stderr, in its own words, and with commands of another age.
void requireRoute(const std::string& url) {
  const sockaddr_in address = parseUdpm(url);
  const Socket probe;
  if (::connect(probe.fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
  throw InputError(fmt::format(
      "LCM URL '{}': this machine has no multicast route ({}). As root: ip link set lo up "
      "multicast "
      "on && ip route add 224.0.0.0/4 dev lo. Or run without LCM: ballbot run --in-process",
      url, std::strerror(errno)));
}

}  // namespace

LcmBus::LcmBus(const std::string& url) : url_(url) {
  if (url.compare(0, std::strlen(kUdpm), kUdpm) == 0) requireRoute(url);
  // An empty URL would silently become whatever LCM_DEFAULT_URL says.
  lcm_ = url.empty() ? nullptr : lcm_create(url.c_str());
  if (lcm_ == nullptr) {
    throw InputError(
        fmt::format("LCM cannot use the URL '{}'. Try: udpm://239.255.76.67:7667?ttl=0", url));
  }
  file_descriptor_ = lcm_get_fileno(lcm_);
}

LcmBus::~LcmBus() { lcm_destroy(lcm_); }

void LcmBus::subscribe(const std::string& channel) {
  // The first subscription starts LCM's receiving thread. Signals are not for it: they must wake
  // the thread that waits in receive(), and LCM would only complain on stderr.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  lcm_subscription_t* subscription = lcm_subscribe(lcm_, channel.c_str(), &LcmBus::keep, this);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (subscription == nullptr) {
    throw InputError(fmt::format("LCM URL '{}': cannot subscribe to '{}'", url_, channel));
  }
  lcm_subscription_set_queue_capacity(subscription, 0);  // no limit
}

bool LcmBus::publish(const char* channel, const std::uint8_t* data, std::size_t size) {
  return lcm_publish(lcm_, channel, data, static_cast<unsigned>(size)) == 0;
}

void LcmBus::keep(const _lcm_recv_buf_t* received, const char* channel, void* bus) {
  auto& self = *static_cast<LcmBus*>(bus);
  const auto* bytes = static_cast<const std::uint8_t*>(received->data);
  self.inbox_.channel = channel;
  self.inbox_.data.assign(bytes, bytes + received->data_size);
  self.arrived_ = true;
}

bool LcmBus::receive(const Message*& out, WallDuration timeout) {
  const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(timeout).count();
  if (ns < 0) return false;
  pollfd waiting{file_descriptor_, POLLIN, 0};
  const timespec limit{ns / 1'000'000'000, ns % 1'000'000'000};
  if (::ppoll(&waiting, 1, &limit, nullptr) <= 0) return false;
  arrived_ = false;
  if (lcm_handle(lcm_) != 0) return false;
  // LCM also hands itself messages of its own, of which we see nothing.
  if (!arrived_) return false;
  out = &inbox_;
  return true;
}

int freeUdpPort() {
  std::random_device random;
  std::uniform_int_distribution<int> ports(20'000, 29'999);  // below the range of short-lived ports
  for (int attempt = 0; attempt < 100; ++attempt) {
    const Socket probe;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(ports(random)));
    // Without SO_REUSEADDR this fails where any other socket is bound, LCM's included.
    if (::bind(probe.fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      return ntohs(address.sin_port);
    }
  }
  throw Error(ExitCode::kBadInput, "no UDP port between 20000 and 29999 is free for LCM");
}

std::string udpmNetwork(const std::string& url) {
  if (url.compare(0, std::strlen(kUdpm), kUdpm) != 0) {
    throw InputError(fmt::format("LCM URL '{}' does not begin with {}", url, kUdpm));
  }
  const sockaddr_in address = parseUdpm(url);
  return fmt::format("{}:{}", inet_ntoa(address.sin_addr), ntohs(address.sin_port));
}

}  // namespace ballbot
