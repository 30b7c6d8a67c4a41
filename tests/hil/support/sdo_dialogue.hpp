#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hil/canopen_codec.hpp"
#include "hil/emulator/canopen_node.hpp"
#include "hil/sdo_client.hpp"

namespace ballbot {

/// A master's SDO client talking to an emulated node, frame by frame.
class SdoDialogue {
 public:
  explicit SdoDialogue(CanopenNode& node) : node_(node), client_(node.id(), 3) {}

  /// Value of the object, or nothing if it was refused; abortCode() says why.
  std::optional<std::int64_t> read(std::uint16_t index, std::uint8_t sub = 0) {
    client_.upload({index, sub}, queue_);
    run();
    if (client_.status() != SdoClient::Status::kDone) return std::nullopt;
    return static_cast<std::int64_t>(
        getLittleEndian(client_.data(), std::min<std::size_t>(client_.size(), 8)));
  }
  std::string readText(std::uint16_t index) {
    client_.upload({index, 0}, queue_);
    run();
    return {reinterpret_cast<const char*>(client_.data()), client_.size()};
  }
  /// Abort code, 0 if it was accepted.
  std::uint32_t write(std::uint16_t index, std::uint8_t sub, std::int64_t value, std::size_t size) {
    std::uint8_t bytes[8];
    putLittleEndian(bytes, static_cast<std::uint64_t>(value), 8);
    client_.download({index, sub}, bytes, size, queue_);
    run();
    return client_.status() == SdoClient::Status::kDone ? 0 : client_.abortCode();
  }
  std::uint32_t abortCode() const { return client_.abortCode(); }
  const SdoClient& client() const { return client_; }

 private:
  void run() {
    for (int rounds = 0; rounds < 100 && client_.status() == SdoClient::Status::kBusy; ++rounds) {
      const FrameQueue sent = queue_;
      queue_.clear();
      for (const CanFrame& frame : sent) node_.onFrame(frame);
      for (const CanFrame& frame : node_.outbox()) client_.onFrame(frame, queue_);
      node_.outbox().clear();
      if (queue_.size() == 0) client_.onTick(queue_);
    }
    queue_.clear();
  }

  CanopenNode& node_;
  SdoClient client_;
  FrameQueue queue_;
};

}  // namespace ballbot
