#pragma once

#include <chrono>

#include "cosim/transport.hpp"

namespace ballbot {

/// How long to wait before asking again: a smoothed round-trip time plus four deviations (Jacobson
/// and Karels, "Congestion Avoidance and Control", 1988); from the third try on doubled each time,
/// up to a limit, since by then the far end is rather busy than deaf. A reply to a repeated request
/// is not measured, as it may belong to either (Karn and Partridge, 1987).
class RetransmissionTimer {
 public:
  static constexpr WallDuration kShortest = std::chrono::milliseconds{1};
  static constexpr WallDuration kLongest = std::chrono::milliseconds{200};

  /// Wait before try number `tries` + 1, when `tries` were made.
  WallDuration wait(int tries) const;
  /// The reply to a request that was sent once took this long.
  void measured(WallDuration round_trip);

 private:
  WallDuration smoothed_ = std::chrono::milliseconds{20}, deviation_{};
  bool any_ = false;
};

}  // namespace ballbot
