#pragma once

#include <vector>

#include "hil/bench_config.hpp"

namespace ballbot {

/// How full a bus will be, as a share of its time.
struct BusBudget {
  int frames_per_cycle = 0;  ///< SYNC and PDOs; what comes more rarely is in the shares alone
  double nominal = 0;        ///< without stuff bits that depend on the frames' content
  double worst = 0;          ///< with the most of them
};

/// What a bench file asks of its buses while torque is on: SYNC, PDOs, heartbeats, parameters that
/// are read back. One for every bus.
std::vector<BusBudget> busBudget(const BenchConfig& config);

/// @throw InputError if a bus of a real-time bench has less time than its frames need.
void requireRoom(const BenchConfig& config);

}  // namespace ballbot
