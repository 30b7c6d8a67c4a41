#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "cosim/transport.hpp"

namespace ballbot {

/// Where two processes of a run meet.
struct LcmAddress {
  std::string url;      ///< LCM provider, e.g. "udpm://239.255.76.67:7667?ttl=0"
  std::string channel;  ///< first part of the two LCM channels' names
};
constexpr const char* kRequestSuffix = "_REQUEST";
constexpr const char* kReplySuffix = "_REPLY";

/// The meeting place when nobody says otherwise, for processes started by hand in several
/// terminals. ttl 0: nothing leaves this machine.
LcmAddress sharedLcmAddress();

/// One that no other run on this machine uses: a multicast port nobody listens to and a channel
/// name drawn at random. ttl 0.
/// @throw Error if this machine has no multicast route.
LcmAddress privateLcmAddress();

/// Letters, digits, '_' and '-' only: to LCM's own tools names are regular expressions.
/// @throw InputError otherwise.
void requireChannelName(const std::string& channel);

enum class LinkEnd { kMaster, kParticipant };

/// One end of a link over LCM.
class LcmTransport final : public Transport {
 public:
  /// @throw InputError if LCM cannot use the URL or the machine has no multicast route; the text
  ///        says which, and the command that mends it.
  LcmTransport(const LcmAddress& address, LinkEnd end);
  ~LcmTransport() override;

  void send(const std::uint8_t* data, std::size_t size) override;
  bool receive(Bytes& out, WallDuration timeout) override;
  std::string describe() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
