#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "hil/bench.hpp"
#include "hil/bench_signals.hpp"
#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

/// Runs the cycles of a bench for whoever commands it. Cycle numbers count from the one in which
/// the drives were enabled, which is 0.
class BenchRunner {
 public:
  virtual ~BenchRunner() = default;

  /// Brings the drives up and enables them; on return sample() is that of cycle 0.
  /// @throw LostParticipantError "bench: ..." if that fails or the bench is in fault;
  ///        InterruptedError once the stop flag is set.
  virtual void engage() = 0;
  /// The command in force from `cycle` on.
  virtual void command(std::int64_t cycle, const BenchCommand& command) = 0;
  /// Waits for the sample of `cycle`.
  /// @throw LostParticipantError once the bench is in fault; it has stopped the drives by itself;
  ///        TorqueNotOffError if a drive has not said that it is off;
  ///        InterruptedError, after release(), once the stop flag is set.
  virtual const BenchSample& sample(std::int64_t cycle) = 0;
  /// Ends a session: bounded damping, torque off, every drive's word for it awaited. Never throws,
  /// and returns in bounded time.
  virtual void release() noexcept = 0;
  /// After release(): says in words if the session did not end as it should.
  /// @throw TorqueNotOffError, LostParticipantError.
  virtual void requireGoodEnd() = 0;
  virtual const Bench& bench() const = 0;
  /// The last seconds of the bench; to be read once its cycles have ended.
  virtual const FlightRecorder& recorder() const = 0;

  /// Looked at in every wait, whatever state the bench is in; must outlive this.
  void setStopFlag(const std::atomic<bool>* stop) noexcept { stop_ = stop; }

 protected:
  bool stopWanted() const noexcept { return stop_ != nullptr && stop_->load(); }
  const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace ballbot
