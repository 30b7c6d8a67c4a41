#pragma once

#include <string>

#include "hil/can_bus.hpp"

namespace ballbot {

/// A CAN bus of the kernel: an interface such as can0. Its bit rates are set with `ip link`.
class SocketCanBus final : public CanBus {
 public:
  /// @throw InputError if the kernel has no CAN, or there is no such interface, or it is down, or
  /// it is
  ///        to be CAN FD and is not; the text has the command that mends it.
  explicit SocketCanBus(const std::string& interface, const CanBusSettings& settings = {});
  /// Takes over a socket that carries such frames; it must not block.
  SocketCanBus(int socket, const std::string& name) : interface_(name), socket_(socket) {}
  ~SocketCanBus() override;
  SocketCanBus(const SocketCanBus&) = delete;
  SocketCanBus& operator=(const SocketCanBus&) = delete;

  bool send(const CanFrame& frame) noexcept override;
  bool receive(CanFrame& out) noexcept override;
  bool waitReadable(std::chrono::nanoseconds timeout) noexcept override;
  int descriptor() const noexcept override { return socket_; }
  bool isUp() const noexcept override { return up_; }
  const CanCounters& counters() const noexcept override { return counters_; }
  std::string describe() const override { return "SocketCAN interface " + interface_; }

 private:
  std::string interface_;
  int socket_ = -1;
  bool up_ = true;
  CanCounters counters_;
};

}  // namespace ballbot
