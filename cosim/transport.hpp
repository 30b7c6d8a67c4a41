#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "messages/wire.hpp"

namespace ballbot {

/// Wall-clock time of the machine: for waiting and giving up, never for results.
using WallClock = std::chrono::steady_clock;
using WallDuration = WallClock::duration;

/// One end of a link between two processes that carries whole messages, in both directions. It may
/// lose, double, reorder, delay and damage them; the step protocol copes.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Sends one message; does not wait for anybody.
  virtual void send(const std::uint8_t* data, std::size_t size) = 0;
  /// Waits, without spinning, until a message is there; false after `timeout` or when a signal
  /// came. `out` keeps its memory between calls.
  virtual bool receive(Bytes& out, WallDuration timeout) = 0;

  /// For messages to people: "udpm://239.255.76.67:7667?ttl=0, channel BALLBOT".
  virtual std::string describe() const = 0;
};

}  // namespace ballbot
