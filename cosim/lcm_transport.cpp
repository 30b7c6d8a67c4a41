#include "cosim/lcm_transport.hpp"

#include <random>

#include <fmt/format.h>

#include "core/error.hpp"
#include "cosim/lcm_bus.hpp"

namespace ballbot {

LcmAddress sharedLcmAddress() { return {"udpm://239.255.76.67:7667?ttl=0", "BALLBOT"}; }

LcmAddress privateLcmAddress() {
  std::random_device random;
  return {fmt::format("udpm://239.255.76.67:{}?ttl=0", freeUdpPort()),
          fmt::format("BALLBOT_{:08X}", random())};
}

void requireChannelName(const std::string& channel) {
  constexpr const char* kAllowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  constexpr std::size_t kLongest = 48;  // LCM takes 63 characters, with our suffix
  if (!channel.empty() && channel.size() <= kLongest &&
      channel.find_first_not_of(kAllowed) == std::string::npos) {
    return;
  }
  throw InputError(fmt::format("LCM channel '{}' must be 1 to {} characters out of A-Z a-z 0-9 _ -",
                               channel, kLongest));
}

struct LcmTransport::Impl {
  explicit Impl(const LcmAddress& address) : bus(address.url) {}
  LcmBus bus;
  std::string channel, send_channel;
};

LcmTransport::LcmTransport(const LcmAddress& address, LinkEnd end) {
  requireChannelName(address.channel);
  impl_ = std::make_unique<Impl>(address);
  impl_->channel = address.channel;
  const std::string request = address.channel + kRequestSuffix;
  const std::string reply = address.channel + kReplySuffix;
  impl_->send_channel = end == LinkEnd::kMaster ? request : reply;
  impl_->bus.subscribe(end == LinkEnd::kMaster ? reply : request);
}

LcmTransport::~LcmTransport() = default;

void LcmTransport::send(const std::uint8_t* data, std::size_t size) {
  // What the network does not take is lost like any other message: the step protocol asks again.
  (void)impl_->bus.publish(impl_->send_channel.c_str(), data, size);
}

bool LcmTransport::receive(Bytes& out, WallDuration timeout) {
  const LcmBus::Message* message = nullptr;
  if (!impl_->bus.receive(message, timeout)) return false;
  out.assign(message->data.begin(), message->data.end());
  return true;
}

std::string LcmTransport::describe() const {
  return fmt::format("{}, channel {}", impl_->bus.url(), impl_->channel);
}

}  // namespace ballbot
