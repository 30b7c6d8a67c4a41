#pragma once

#include <atomic>

namespace ballbot {

/// What a second Ctrl-C does.
enum class SecondSignal {
  kEnds,        ///< ends the process at once
  kIsAbsorbed,  ///< nothing: drives with torque on must be brought down first, in bounded time
};

/// Set by Ctrl-C or SIGTERM from the first call on. Absorbed once is absorbed for good.
const std::atomic<bool>* interruptFlag(SecondSignal second = SecondSignal::kEnds);

}  // namespace ballbot
