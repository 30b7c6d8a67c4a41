#pragma once

#include <cstdint>

namespace ballbot {

/// A number that no other run or process has: drawn from the machine, not from a seed. It tells
/// sessions apart and never enters a result.
std::uint64_t drawSessionId();

}  // namespace ballbot
