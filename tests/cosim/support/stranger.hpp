#pragma once

#include <cstdint>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_url.hpp"

namespace ballbot::testing_support {

/// Somebody on an LCM network who sends whole UDP packets as he likes.
class Stranger {
 public:
  explicit Stranger(const std::string& url) {
    const LcmUrl parsed = LcmUrl::parse(url);
    to_.sin_family = AF_INET;
    to_.sin_addr.s_addr = inet_addr(parsed.group.c_str());
    to_.sin_port = htons(parsed.port);
  }

  void send(const Bytes& packet) {
    (void)::sendto(socket_.fd(), packet.data(), packet.size(), 0,
                   reinterpret_cast<const sockaddr*>(&to_), sizeof to_);
  }

 private:
  UdpSocket socket_;
  sockaddr_in to_{};
};

/// A packet with a part of a long message, as LCM splits them: 80 bytes in all.
inline Bytes fragment(std::uint32_t message_bytes, std::uint32_t offset, std::uint16_t number,
                      std::uint16_t count, const std::string& channel) {
  Bytes out{'L', 'C', '0', '3'};
  const auto put = [&out](std::uint32_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  };
  put(1, 4);  // sequence
  put(message_bytes, 4);
  put(offset, 4);
  put(number, 2);
  put(count, 2);
  if (number == 0) out.insert(out.end(), channel.c_str(), channel.c_str() + channel.size() + 1);
  out.resize(80, 0xAA);
  return out;
}

}  // namespace ballbot::testing_support
