#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "messages/wire.hpp"

namespace ballbot {

/// LCM's limit on the name of a channel.
constexpr std::size_t kMaxChannelBytes = 63;
/// The longest packet this program sends or takes: magic number, sequence, channel, message.
constexpr std::size_t kMaxPacketBytes = 8 + kMaxChannelBytes + 1 + kMaxMessageBytes;

/// 1 to kMaxChannelBytes characters out of A-Z a-z 0-9 _ -.
bool isChannelName(std::string_view name) noexcept;

/// One message as it lies in a UDP packet. Both parts point into the packet.
struct LcmPacket {
  std::string_view channel;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// Reads the packet of a short message of LCM's multicast provider: "LC02", a sequence number of 4
/// bytes, the channel with a zero at its end, the message. Nothing for any other packet: parts of
/// long messages, which this program never sends; one that is cut; a channel without end or
/// with no isChannelName; a message beyond kMaxMessageBytes.
std::optional<LcmPacket> parseLcmPacket(const std::uint8_t* packet, std::size_t size) noexcept;

/// The same the other way. False, with `out` unspecified, if parseLcmPacket would not take it.
bool buildLcmPacket(std::string_view channel, const std::uint8_t* data, std::size_t size,
                    std::uint32_t sequence, Bytes& out);

}  // namespace ballbot
