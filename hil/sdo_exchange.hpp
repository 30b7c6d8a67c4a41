#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "hil/can_bus.hpp"
#include "hil/frame_queue.hpp"
#include "hil/sdo_client.hpp"

namespace ballbot {

/// Asks and tells one node over one bus, one SDO transfer after the other, while no session runs.
class SdoExchange {
 public:
  /// @param patience  with one answer; every segment has all of it
  /// @param flexible  the bus carries CAN FD
  SdoExchange(CanBus& bus, int node, std::chrono::milliseconds patience, bool flexible = false)
      : bus_(bus), node_(node), patience_(patience) {
    queue_.setFlexible(flexible);
  }

  /// Nothing where the node is silent or has no such object.
  std::optional<std::int64_t> number(std::uint16_t index, std::uint8_t sub = 0);
  std::optional<std::string> text(std::uint16_t index);
  /// @param size  of the object, 1 to 4 bytes
  /// @return whether the node took it
  bool write(std::uint16_t index, std::uint8_t sub, std::int64_t value, std::size_t size);
  /// Why the last one gave nothing: "6079:00 supply voltage: no answer within 500 ms".
  std::string whyNot(const char* what) const;

 private:
  bool upload(std::uint16_t index, std::uint8_t sub);
  bool carryOut();

  CanBus& bus_;
  int node_;
  std::chrono::milliseconds patience_;
  SdoClient client_{node_, 1 << 20};
  FrameQueue queue_;
};

}  // namespace ballbot
