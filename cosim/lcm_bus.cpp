#include "cosim/lcm_bus.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"
#include "cosim/lcm_url.hpp"

namespace ballbot {
namespace {

sockaddr_in addressOf(const LcmUrl& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = inet_addr(url.group.c_str());
  address.sin_port = htons(url.port);
  return address;
}

const sockaddr* generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

[[noreturn]] void refuse(const std::string& url, const std::string& what) {
  throw InputError(
      fmt::format("LCM URL '{}': {}: {}. Try: ballbot doctor", url, what, std::strerror(errno)));
}

template <typename Value>
void setOption(int fd, int level, int option, const Value& value, const std::string& url) {
  if (::setsockopt(fd, level, option, &value, sizeof value) != 0) {
    refuse(url, "a socket cannot be set up");
  }
}

void requireRoute(const LcmUrl& parsed, const std::string& url) {
  const sockaddr_in address = addressOf(parsed);
  const UdpSocket probe;
  if (::connect(probe.fd(), generic(address), sizeof address) == 0) return;
  throw InputError(
      fmt::format("LCM URL '{}': this machine has no multicast route ({}). As root: {}. Or run "
                  "without LCM: ballbot run --in-process",
                  url, std::strerror(errno), kMulticastRemedy));
}

void openReceiver(int fd, const LcmUrl& parsed, const std::string& url) {
  setOption(fd, SOL_SOCKET, SO_REUSEADDR, 1, url);  // each process of a run binds the same port
  setOption(fd, SOL_SOCKET, SO_RCVBUF, parsed.receive_buffer_bytes, url);
  // Bound to the group, not to the machine: packets sent to one of its own addresses do not come.
  const sockaddr_in address = addressOf(parsed);
  if (::bind(fd, generic(address), sizeof address) != 0) refuse(url, "cannot listen");
  ip_mreq membership{};
  membership.imr_multiaddr = address.sin_addr;
  membership.imr_interface.s_addr = htonl(INADDR_ANY);
  setOption(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership, url);
}

bool endsWith(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

bool waitReadable(int fd, WallDuration timeout) {
  const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(timeout).count();
  if (ns < 0) return false;
  pollfd waiting{fd, POLLIN, 0};
  const timespec limit{ns / 1'000'000'000, ns % 1'000'000'000};
  return ::ppoll(&waiting, 1, &limit, nullptr) > 0;
}

}  // namespace

UdpSocket::UdpSocket() : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
UdpSocket::~UdpSocket() {
  if (fd_ >= 0) ::close(fd_);
}

LcmBus::LcmBus(const std::string& url) : url_(url) {
  const LcmUrl parsed = LcmUrl::parse(url);
  if (receiver_.fd() < 0 || sender_.fd() < 0) refuse(url, "no socket");
  requireRoute(parsed, url);
  setOption(sender_.fd(), IPPROTO_IP, IP_MULTICAST_TTL, parsed.ttl, url);
  destination_ = addressOf(parsed);
  openReceiver(receiver_.fd(), parsed, url);
  packet_.resize(kMaxPacketBytes + 1);  // one more, so that a longer packet shows
}

void LcmBus::subscribe(const std::string& channel) { channels_.push_back(channel); }

void LcmBus::subscribeToEnding(const std::string& ending) { endings_.push_back(ending); }

bool LcmBus::publish(const std::string& channel, const std::uint8_t* data, std::size_t size) {
  if (!buildLcmPacket(channel, data, size, sequence_++, outgoing_)) return false;
  const ssize_t sent = ::sendto(sender_.fd(), outgoing_.data(), outgoing_.size(), 0,
                                generic(destination_), sizeof destination_);
  return sent == static_cast<ssize_t>(outgoing_.size());
}

bool LcmBus::receive(const Message*& out, WallDuration timeout) {
  const WallClock::time_point until = WallClock::now() + timeout;
  // Packets for others end no wait; a flood of them does not prolong it.
  for (WallDuration left = timeout; waitReadable(receiver_.fd(), left);
       left = until - WallClock::now()) {
    if (!take()) continue;
    out = &inbox_;
    return true;
  }
  return false;
}

// Reads one packet; false if it is none of ours.
bool LcmBus::take() {
  const ssize_t size = ::recv(receiver_.fd(), packet_.data(), packet_.size(), MSG_DONTWAIT);
  if (size < 0) return false;
  const auto packet = parseLcmPacket(packet_.data(), static_cast<std::size_t>(size));
  if (!packet || !wanted(packet->channel)) return false;
  inbox_.channel = packet->channel;
  inbox_.data.assign(packet->data, packet->data + packet->size);
  return true;
}

bool LcmBus::wanted(std::string_view channel) const {
  return std::find(channels_.begin(), channels_.end(), channel) != channels_.end() ||
         std::any_of(endings_.begin(), endings_.end(),
                     [&](const std::string& ending) { return endsWith(channel, ending); });
}

int freeUdpPort() {
  std::random_device random;
  std::uniform_int_distribution<int> ports(20'000, 29'999);  // below the range of short-lived ports
  for (int attempt = 0; attempt < 100; ++attempt) {
    const UdpSocket probe;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(ports(random)));
    // Without SO_REUSEADDR this fails where any other socket is bound, LCM's included.
    if (::bind(probe.fd(), generic(address), sizeof address) == 0) return ntohs(address.sin_port);
  }
  throw Error(ExitCode::kBadInput, "no UDP port between 20000 and 29999 is free for LCM");
}

}  // namespace ballbot
