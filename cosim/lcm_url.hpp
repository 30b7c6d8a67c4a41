#pragma once

#include <cstdint>
#include <string>

namespace ballbot {

/// An LCM network: udpm://GROUP:PORT[?ttl=N][&recv_buf_size=BYTES], as LCM's own tools take it.
struct LcmUrl {
  std::string group;       ///< IPv4 multicast address, e.g. "239.255.76.67"
  std::uint16_t port = 0;  ///< UDP port, 1 to 65535
  int ttl = 0;  ///< routers that packets may pass, 0 to 255; 0: they stay on this machine
  int receive_buffer_bytes = 2 << 20;  ///< asked of the system, which may give less

  /// @throw InputError for anything else: another provider, an option that is unknown, doubled or
  ///        out of range.
  static LcmUrl parse(const std::string& url);
  /// "GROUP:PORT": two URLs with the same are the same network.
  std::string network() const;
};

}  // namespace ballbot
