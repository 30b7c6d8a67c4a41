#pragma once

#include <cstdint>
#include <string>

#include "hil/can_frame.hpp"

namespace ballbot {

/// The far side of the LAWICEL protocol: a serial CAN adapter as software, for the emulated bench.
/// Written apart from the host's codec, so that the two check each other. No file, no clock.
class SlcanAdapter {
 public:
  /// @param flexible  whether it has CAN FD, by the commands of CANable adapters
  explicit SlcanAdapter(bool flexible = false) : flexible_(flexible) {}

  /// Takes one character from the host. If it ends a command, `reply` gets the answer appended and,
  /// if the command was to send a frame, the result is true and `sent` holds the frame.
  bool take(char c, std::string& reply, CanFrame& sent);

  /// A frame from the bus as the host is shown it; nothing while the channel is closed.
  /// @param time_ms for the time stamp, if the host has asked for such
  void show(const CanFrame& frame, std::int64_t time_ms, std::string& reply) const;

  bool isOpen() const { return open_; }
  /// Digit of the S command; 8, which is 1 Mbit/s, until one came.
  int rate() const { return rate_; }
  /// Set by the bus: answer to F, cleared by it.
  void setStatus(std::uint8_t flags) { status_ = flags; }

 private:
  bool act(std::string& reply, CanFrame& sent);
  bool transmit(std::string& reply, CanFrame& sent);

  std::string line_;
  bool flexible_;
  bool open_ = false, listen_only_ = false, stamps_ = false;
  int rate_ = 8;  // the emulated bus runs at 1 Mbit/s
  std::uint8_t status_ = 0;
};

}  // namespace ballbot
