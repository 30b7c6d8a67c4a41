#include "hil/socketcan_bus.hpp"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"
#include "hil/serial_port.hpp"
#include "hil/socketcan_frame.hpp"

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

/// The command that sets an interface up.
std::string ipLink(const std::string& interface, const CanBusSettings& s) {
  std::string out =
      fmt::format("ip link set {} up type can bitrate {}", interface, 1000 * s.bitrate_kbps);
  if (s.flexible()) out += fmt::format(" dbitrate {} fd on", 1000 * s.data_bitrate_kbps);
  return out;
}

}  // namespace

SocketCanBus::SocketCanBus(const std::string& interface, const CanBusSettings& settings)
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
    refuse("is down. Try: " + ipLink(interface, settings));
  }
  if (settings.flexible()) {
    const int on = 1;
    if (::ioctl(socket_, SIOCGIFMTU, &request) != 0 || request.ifr_mtu != CANFD_MTU ||
        ::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0) {
      refuse("is no CAN FD interface, or not set up as one. Try: ip link set " + interface +
             " down && " + ipLink(interface, settings));
    }
  }
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_CRTL | CAN_ERR_RESTARTED;
  ::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    refuse(fmt::format("cannot be bound: {}", std::strerror(errno)));
  }
}

SocketCanBus::~SocketCanBus() { ::close(socket_); }

bool SocketCanBus::send(const CanFrame& frame) noexcept {
  canfd_frame raw;
  const std::size_t size = toKernel(frame, raw);
  if (size == 0 || ::write(socket_, &raw, size) != static_cast<ssize_t>(size)) {
    if (size != 0 && (errno == ENETDOWN || errno == ENXIO || errno == ENODEV)) up_ = false;
    ++counters_.refused;
    return false;
  }
  ++counters_.sent;
  return true;
}

bool SocketCanBus::receive(CanFrame& out) noexcept {
  canfd_frame raw{};
  for (;;) {
    const ssize_t n = ::read(socket_, &raw, sizeof raw);
    if (n < 0) {
      if (errno != EAGAIN && errno != EINTR) up_ = false;
      return false;
    }
    switch (fromKernel(raw, static_cast<std::size_t>(n), out)) {
      case KernelFrame::kFrame:
        ++counters_.received;
        return true;
      case KernelFrame::kError:
        ++counters_.errors;
        if ((raw.can_id & CAN_ERR_BUSOFF) != 0) up_ = false;
        break;
      case KernelFrame::kMalformed:
        ++counters_.malformed;
        if (n == 0) return false;  // the other end is gone
        break;
    }
  }
}

bool SocketCanBus::waitReadable(std::chrono::nanoseconds timeout) noexcept {
  return pollReadable(socket_, timeout);
}

}  // namespace ballbot
