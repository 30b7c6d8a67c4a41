#pragma once

#include <cstdint>

namespace ballbot {

/// Wall clock for the time of a solve's phases, in nanoseconds; whoever wants times passes one in.
/// Times never take part in a result.
using PhaseClock = std::int64_t (*)() noexcept;

struct PhaseTimes {
  std::int64_t approximation_ns = 0, riccati_ns = 0, line_search_ns = 0;
};

}  // namespace ballbot
