#pragma once

#include <cstdint>

#include "hil/bench_config.hpp"
#include "hil/bench_signals.hpp"
#include "hil/doubt/finding.hpp"

namespace ballbot {

/// Doubts the controller: is its command new, is it later than the last, does it change, can it be
/// meant? The one watchdog of both runners. Pure; check() once per cycle in which torque follows.
class CommandDoubt {
 public:
  explicit CommandDoubt(const BenchConfig& config) : config_(config) {}

  /// Torque does not follow commands now: whatever comes is too early, and no age counts.
  void rest() noexcept;
  /// @param command  in force; null: none yet
  /// @param number   grows with every new command, by whatever amount
  Finding check(const BenchCommand* command, std::int64_t number) noexcept;
  /// Cycles since the command in force was new.
  int age() const noexcept { return age_; }

 private:
  Finding checkValues(const BenchCommand& command) noexcept;

  const BenchConfig& config_;
  std::int64_t last_number_ = -1;
  int age_ = 0, repeats_ = 0, absurd_ = 0;
  BenchCommand last_;
  bool has_last_ = false;
};

}  // namespace ballbot
