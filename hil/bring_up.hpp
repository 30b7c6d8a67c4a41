#pragma once

#include <chrono>

#include "hil/bench.hpp"
#include "hil/bench_io.hpp"

namespace ballbot {

/// Resets and configures all nodes of a bench and starts them.
/// @param patience  wall-clock time without an answer that counts as one cycle, if longer than one;
///                  time-outs are counted in cycles
/// @throw LostParticipantError naming the node and what it refused.
void bringUp(Bench& bench, BenchIo& io, std::chrono::nanoseconds patience);

}  // namespace ballbot
