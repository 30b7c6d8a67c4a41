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
  constexpr std::size_t kLongest = 48;  // with our suffix it stays below kMaxChannelBytes
  if (isChannelName(channel) && channel.size() <= kLongest) return;
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
  (void)impl_->bus.publish(impl_->send_channel, data, size);
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
