#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "hil/bench.hpp"
#include "hil/bench_io.hpp"

namespace ballbot {

/// Resets and configures all nodes of a bench and starts them.
/// @param slowness  periods without an answer that count as one cycle: time-outs are counted in
///                  cycles, and longer where nothing depends on them
/// @param stop      ends it between two answers; null: nothing does
/// @param say       is told again and again how far it is; may be empty
/// @throw LostParticipantError naming the node and what it refused; InterruptedError.
void bringUp(Bench& bench, BenchIo& io, int slowness, const std::atomic<bool>* stop = nullptr,
             const std::function<void(const std::string&)>& say = {});

/// Throws what is to be said about a bench that has come down by itself.
/// @throw TorqueNotOffError if a drive has not said that it is off, else LostParticipantError if
///        the bench is in fault.
void requireGoodEnd(const Bench& bench);

}  // namespace ballbot
