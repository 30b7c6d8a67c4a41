#pragma once

#include <atomic>
#include <chrono>

#include "hil/bench.hpp"
#include "hil/bench_io.hpp"

namespace ballbot {

/// Resets and configures all nodes of a bench and starts them.
/// @param patience  wall-clock time without an answer that counts as one cycle, if longer than one;
///                  time-outs are counted in cycles
/// @param stop      ends it between two answers; null: nothing does
/// @throw LostParticipantError naming the node and what it refused; InterruptedError.
void bringUp(Bench& bench, BenchIo& io, std::chrono::nanoseconds patience,
             const std::atomic<bool>* stop = nullptr);

/// Throws what is to be said about a bench that has come down by itself.
/// @throw TorqueNotOffError if a drive has not said that it is off, else LostParticipantError if
///        the bench is in fault.
void requireGoodEnd(const Bench& bench);

}  // namespace ballbot
