#pragma once

#include <cstdint>

namespace ballbot {

/// Heap allocations of this process so far, whoever made them: linking allocation_counter.cpp
/// replaces malloc and its kin. Sanitizers bring a malloc of their own; nothing is counted then.
std::int64_t allocationCount();
bool allocationsAreCounted();

}  // namespace ballbot
