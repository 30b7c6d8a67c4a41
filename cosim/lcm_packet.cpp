#include "cosim/lcm_packet.hpp"

#include <algorithm>
#include <cstring>

namespace ballbot {
namespace {

constexpr std::uint8_t kMagic[4] = {'L', 'C', '0', '2'};
constexpr std::size_t kHeaderBytes = 8;

bool isChannelCharacter(char c) noexcept {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

}  // namespace

bool isChannelName(std::string_view name) noexcept {
  return !name.empty() && name.size() <= kMaxChannelBytes &&
         std::all_of(name.begin(), name.end(), isChannelCharacter);
}

std::optional<LcmPacket> parseLcmPacket(const std::uint8_t* packet, std::size_t size) noexcept {
  if (size < kHeaderBytes || std::memcmp(packet, kMagic, sizeof kMagic) != 0) return std::nullopt;
  const std::uint8_t* const begin = packet + kHeaderBytes;
  const std::uint8_t* const end = packet + size;
  const std::uint8_t* const zero = std::find(begin, end, std::uint8_t{0});
  if (zero == end) return std::nullopt;
  LcmPacket out;
  out.channel = {reinterpret_cast<const char*>(begin), static_cast<std::size_t>(zero - begin)};
  out.data = zero + 1;
  out.size = static_cast<std::size_t>(end - out.data);
  if (!isChannelName(out.channel) || out.size > kMaxMessageBytes) return std::nullopt;
  return out;
}

bool buildLcmPacket(std::string_view channel, const std::uint8_t* data, std::size_t size,
                    std::uint32_t sequence, Bytes& out) {
  if (!isChannelName(channel) || size > kMaxMessageBytes) return false;
  out.assign(kMagic, kMagic + sizeof kMagic);
  for (int shift = 24; shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::uint8_t>(sequence >> shift));
  }
  out.insert(out.end(), channel.begin(), channel.end());
  out.push_back(0);
  out.insert(out.end(), data, data + size);
  return true;
}

}  // namespace ballbot
