#pragma once

#include <memory>
#include <utility>

#include "cosim/transport.hpp"

namespace ballbot {

/// Both ends of a link within one process; each end may be used by a thread of its own. Nothing is
/// lost or reordered.
std::pair<std::unique_ptr<Transport>, std::unique_ptr<Transport>> makeMemoryLink();

}  // namespace ballbot
