#pragma once

#include "hil/bench_fault.hpp"

namespace ballbot {

/// What a check found wrong: which, at which drive, and by how much.
struct Finding {
  BenchFault fault = BenchFault::kNone;
  int drive = -1;  ///< 0 to 5; the master's number of the IMU; -1: none in particular
  double value = 0, limit = 0;

  explicit operator bool() const noexcept { return fault != BenchFault::kNone; }
};

}  // namespace ballbot
