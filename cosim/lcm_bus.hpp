#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "cosim/transport.hpp"

struct _lcm_t;
struct _lcm_recv_buf_t;

namespace ballbot {

/// A connection to an LCM network: the one place of this program that uses LCM itself.
class LcmBus {
 public:
  struct Message {
    std::string channel;
    Bytes data;
  };

  /// @throw InputError if LCM cannot use the URL, or the machine has no multicast route; the text
  ///        has the command that mends it.
  explicit LcmBus(const std::string& url);
  ~LcmBus();
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  /// @param channel a regular expression that must match the whole name.
  void subscribe(const std::string& channel);
  /// Whether the network took the message; it may still lose it.
  bool publish(const char* channel, const std::uint8_t* data, std::size_t size);
  /// Waits in poll() for the next message of a subscribed channel, in the order of arrival; false
  /// after `timeout`, at a signal, or when LCM had something to do for itself. The message is valid
  /// until the next call.
  bool receive(const Message*& out, WallDuration timeout);
  /// Readable when a message waits.
  int fileDescriptor() const { return file_descriptor_; }
  const std::string& url() const { return url_; }

 private:
  static void keep(const _lcm_recv_buf_t* received, const char* channel, void* bus);

  std::string url_;
  _lcm_t* lcm_;
  int file_descriptor_;
  Message inbox_;
  bool arrived_ = false;
};

/// A UDP port that nobody on this machine listens to, for a multicast network of one's own.
int freeUdpPort();

/// "HOST:PORT" of a udpm URL: two URLs with the same are the same network.
/// @throw InputError if it is not "udpm://HOST:PORT[?OPTION=VALUE...]" with a multicast address.
std::string udpmNetwork(const std::string& url);

}  // namespace ballbot
