#pragma once

#include <array>
#include <cstddef>

#include "hil/bench_fault.hpp"

namespace ballbot {

/// What a check found wrong: which, at which drive, and by how much.
struct Finding {
  BenchFault fault = BenchFault::kNone;
  int drive = -1;  ///< 0 to 5; the master's number of the IMU; -1: none in particular
  double value = 0, limit = 0;

  explicit operator bool() const noexcept { return fault != BenchFault::kNone; }
};

/// All that was found wrong in one cycle, in order; of fixed size, what is too much is left out.
class FindingList {
 public:
  static constexpr std::size_t kCapacity = 64;

  void push(const Finding& found) noexcept {
    if (size_ < kCapacity) list_[size_++] = found;
  }
  void clear() noexcept { size_ = 0; }
  const Finding* begin() const noexcept { return list_.data(); }
  const Finding* end() const noexcept { return list_.data() + size_; }

 private:
  std::array<Finding, kCapacity> list_{};
  std::size_t size_ = 0;
};

}  // namespace ballbot
