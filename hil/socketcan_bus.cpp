#include "hil/socketcan_bus.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"
#include "hil/serial_port.hpp"

namespace ballbot {
namespace {

int openSocket(const std::string& interface) {
  const int s = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (s >= 0) return s;
  if (errno == EAFNOSUPPORT) {
    throw InputError(fmt::format(
        "{}: this kernel has no CAN (AF_CAN). Load it with `modprobe can_raw`, or use an slcan "
        "adapter's serial device instead",
        interface));
  }
  throw InputError(fmt::format("{}: no CAN socket: {}", interface, std::strerror(errno)));
}

}  // namespace

SocketCanBus::SocketCanBus(const std::string& interface)
    : interface_(interface), socket_(openSocket(interface)) {
  const auto refuse = [&](const std::string& text) {
    ::close(socket_);
    throw InputError(interface + ": " + text);
  };
  ifreq request{};
  if (interface.size() >= sizeof request.ifr_name) refuse("is no name of a network interface");
  std::memcpy(request.ifr_name, interface.data(), interface.size());
  if (::ioctl(socket_, SIOCGIFINDEX, &request) != 0) {
    refuse("there is no such interface. `ip link` lists them");
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = request.ifr_ifindex;
  if (::ioctl(socket_, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) {
    refuse(fmt::format("is down. Try: ip link set {} up type can bitrate 1000000", interface));
  }
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_CRTL | CAN_ERR_RESTARTED;
  ::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    refuse(fmt::format("cannot be bound: {}", std::strerror(errno)));
  }
}

SocketCanBus::~SocketCanBus() { ::close(socket_); }

bool SocketCanBus::send(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.can_dlc = frame.size;
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  if (!isValid(frame) || ::write(socket_, &raw, sizeof raw) != sizeof raw) {
    if (errno == ENETDOWN || errno == ENXIO || errno == ENODEV) up_ = false;
    ++counters_.refused;
    return false;
  }
  ++counters_.sent;
  return true;
}

bool SocketCanBus::receive(CanFrame& out) noexcept {
  can_frame raw{};
  for (;;) {
    const ssize_t n = ::read(socket_, &raw, sizeof raw);
    if (n < 0) {
      if (errno != EAGAIN && errno != EINTR) up_ = false;
      return false;
    }
    if (n != sizeof raw || raw.can_dlc > CanFrame::kMaxSize) {
      ++counters_.malformed;
      continue;
    }
    if ((raw.can_id & CAN_ERR_FLAG) != 0) {
      ++counters_.errors;
      if ((raw.can_id & CAN_ERR_BUSOFF) != 0) up_ = false;
      continue;
    }
    out = CanFrame{};
    out.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    out.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
    out.id = raw.can_id & (out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    out.size = raw.can_dlc;
    if (!out.remote) std::copy(raw.data, raw.data + raw.can_dlc, out.data.begin());
    ++counters_.received;
    return true;
  }
}

bool SocketCanBus::waitReadable(std::chrono::nanoseconds timeout) noexcept {
  return pollReadable(socket_, timeout);
}

}  // namespace ballbot
