#pragma once

#include <cstdint>

namespace ballbot {

/// Wall-clock time that one plan took, and of that its phases; zeros where no clock was given. A
/// fact of the machine: for no record that has to be the same twice.
struct PlanTiming {
  std::int64_t total_ns = 0;
  std::int64_t approximation_ns = 0, riccati_ns = 0, line_search_ns = 0;
};

}  // namespace ballbot
