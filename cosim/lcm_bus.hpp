#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <netinet/in.h>

#include "cosim/lcm_packet.hpp"
#include "cosim/transport.hpp"

namespace ballbot {

/// A file descriptor that closes itself.
class UdpSocket {
 public:
  UdpSocket();  ///< UDP; -1 where the system has none left
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  int fd() const { return fd_; }

 private:
  int fd_;
};

/// A connection to an LCM network: messages of LCM's multicast provider, spoken by this program
/// itself. LCM's own tools (lcm-logger, lcm-spy) hear and are heard. Its library is not used to
/// receive, for whatever a stranger sends would reach its code for parts of long messages, which no
/// message of ours needs: here all but a well-formed short message ends in parseLcmPacket.
class LcmBus {
 public:
  struct Message {
    std::string channel;
    Bytes data;
  };

  /// @throw InputError if the URL is not one of LcmUrl, or the machine has no multicast route; the
  ///        text has the command that mends it.
  explicit LcmBus(const std::string& url);

  /// Takes the messages of one channel from now on.
  void subscribe(const std::string& channel);
  /// Takes those of all channels whose names end so.
  void subscribeToEnding(const std::string& ending);
  /// Whether the network took the message; it may still lose it.
  bool publish(const std::string& channel, const std::uint8_t* data, std::size_t size);
  /// Waits in poll() for the next message of a subscribed channel, in the order of arrival; false
  /// after `timeout` or at a signal. The message is valid until the next call. What waits is
  /// bounded by the socket's buffer: what does not fit is lost, as on any network.
  bool receive(const Message*& out, WallDuration timeout);
  /// Readable when a packet waits.
  int fileDescriptor() const { return receiver_.fd(); }
  const std::string& url() const { return url_; }

 private:
  bool take();
  bool wanted(std::string_view channel) const;

  std::string url_;
  UdpSocket receiver_, sender_;
  sockaddr_in destination_{};
  std::vector<std::string> channels_, endings_;
  std::uint32_t sequence_ = 0;
  Bytes packet_, outgoing_;
  Message inbox_;
};

/// A UDP port that nobody on this machine listens to, for a multicast network of one's own.
int freeUdpPort();

/// Mends a machine without a multicast route, as root.
constexpr const char* kMulticastRemedy =
    "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo";

}  // namespace ballbot
