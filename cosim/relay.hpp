#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "cosim/disturbance.hpp"

namespace ballbot {

/// Stands between a master and its participant on two LCM networks, and spoils the traffic:
/// requests go from `master_url` to `participant_url`, replies the other way.
struct RelayOptions {
  std::string master_url, participant_url;
  std::string channel;  ///< only this run's; empty: every run's
  DisturbanceOptions disturbance;
  const std::atomic<bool>* stop = nullptr;
  /// Set by the relay once it listens on both sides.
  std::atomic<bool>* listening = nullptr;
};

struct RelayReport {
  struct Direction {
    std::int64_t received = 0, lost = 0, duplicated = 0, held_back = 0, sent = 0;
  };
  Direction requests, replies;
};

/// Relays until the stop flag is set.
/// @throw InputError if a URL cannot be used or both are the same network.
RelayReport relay(const RelayOptions& options);

}  // namespace ballbot
