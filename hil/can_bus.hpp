#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "hil/can_frame.hpp"

namespace ballbot {

/// How a bus is to be run.
struct CanBusSettings {
  int bitrate_kbps = 1000;
  bool acknowledges = true;   ///< false: an slcan adapter that answers no command
  int data_bitrate_kbps = 0;  ///< of CAN FD; 0: a classic bus

  bool flexible() const noexcept { return data_bitrate_kbps != 0; }
};

/// What a bus has counted since it was opened.
struct CanCounters {
  std::int64_t sent = 0;       ///< frames handed over
  std::int64_t received = 0;   ///< frames taken
  std::int64_t refused = 0;    ///< frames that could not be sent: no room, device gone
  std::int64_t malformed = 0;  ///< pieces of input that are no frame and no reply
  std::int64_t errors = 0;     ///< error frames, or error replies of the adapter
};

/// One CAN bus. After construction no call allocates, throws or blocks (waitReadable aside), so
/// that the control cycle can use it; a bus that died says so by isUp().
class CanBus {
 public:
  virtual ~CanBus() = default;

  /// Hands one frame over; false, and counted, if it cannot be sent.
  virtual bool send(const CanFrame& frame) noexcept = 0;
  /// Takes the next frame that has arrived; false if there is none.
  virtual bool receive(CanFrame& out) noexcept = 0;
  /// Waits until something may have arrived, at most `timeout`; false if nothing has.
  virtual bool waitReadable(std::chrono::nanoseconds timeout) noexcept = 0;
  /// File descriptor to poll several buses with, or -1.
  virtual int descriptor() const noexcept = 0;
  /// False once the device is gone or the controller is bus-off.
  virtual bool isUp() const noexcept = 0;
  virtual const CanCounters& counters() const noexcept = 0;
  /// For messages to people: "slcan on /dev/ttyACM0, 1000 kbit/s".
  virtual std::string describe() const = 0;
};

}  // namespace ballbot
