#pragma once

#include <cstdint>
#include <string>

#include "hil/bench.hpp"
#include "hil/bench_signals.hpp"

namespace ballbot {

/// Runs the cycles of a bench for whoever commands it. Cycle numbers count from the one in which
/// the drives were enabled, which is 0.
class BenchRunner {
 public:
  virtual ~BenchRunner() = default;

  /// Brings the drives up and enables them; on return sample() is that of cycle 0.
  /// @throw LostParticipantError "bench: ..." if that fails or the bench is in fault.
  virtual void engage() = 0;
  /// The command in force from `cycle` on.
  virtual void command(std::int64_t cycle, const BenchCommand& command) = 0;
  /// Waits for the sample of `cycle`.
  /// @throw LostParticipantError once the bench is in fault; it has stopped the drives by itself.
  virtual const BenchSample& sample(std::int64_t cycle) = 0;
  /// Ends a session: bounded damping, torque off. Never throws.
  virtual void release() noexcept = 0;
  virtual const Bench& bench() const = 0;
};

}  // namespace ballbot
