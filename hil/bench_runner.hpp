#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "hil/bench.hpp"
#include "hil/bench_signals.hpp"
#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

/// Runs the cycles of a bench for whoever commands it. Cycle numbers count from the one in which
/// the drives were enabled, which is 0.
class BenchRunner {
 public:
  virtual ~BenchRunner() = default;

  /// Brings the network up, if it is not yet, and waits for the next sample. No drive is switched
  /// on. Only before engage().
  /// @throw LostParticipantError, InterruptedError as engage().
  virtual const BenchSample& watch() = 0;
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
  /// Whether a check has fired, for whoever waits meanwhile; from any thread.
  virtual bool hasFault() const noexcept { return false; }
  /// The last seconds of the bench; to be read once its cycles have ended.
  virtual const FlightRecorder& recorder() const = 0;

  /// Looked at in every wait, whatever state the bench is in; must outlive this.
  void setStopFlag(const std::atomic<bool>* stop) noexcept { stop_ = stop; }

  /// Told, by the thread that engages, what it is waiting for.
  void setSay(std::function<void(const std::string&)> say) { say_ = std::move(say); }

 protected:
  bool stopWanted() const noexcept { return stop_ != nullptr && stop_->load(); }
  const std::atomic<bool>* stop_ = nullptr;
  std::function<void(const std::string&)> say_;
};

}  // namespace ballbot
