#pragma once

#include <atomic>

namespace ballbot {

/// Set by Ctrl-C or SIGTERM from the first call on. A second Ctrl-C ends the process at once.
const std::atomic<bool>* interruptFlag();

}  // namespace ballbot
