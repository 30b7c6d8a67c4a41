#pragma once

#include "hil/bench_runner.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/rehearsal/lockstep_clock.hpp"

namespace ballbot {

/// A real-time runner for whoever calls it in turn: its loop, in lockstep, runs the cycles that a
/// call waits for and no others.
class LockstepRunner final : public BenchRunner {
 public:
  /// @param clock  that of `inner`; both must outlive this
  LockstepRunner(RealtimeRunner& inner, LockstepClock& clock) : inner_(inner), clock_(clock) {}

  const BenchSample& watch() override;
  void engage() override;
  void command(std::int64_t cycle, const BenchCommand& command) override {
    inner_.command(cycle, command);
  }
  const BenchSample& sample(std::int64_t cycle) override;
  void release() noexcept override;
  void requireGoodEnd() override { inner_.requireGoodEnd(); }
  const Bench& bench() const override { return inner_.bench(); }
  const FlightRecorder& recorder() const override { return inner_.recorder(); }
  bool hasFault() const noexcept override { return inner_.hasFault(); }

 private:
  template <typename Call>
  void whilePumping(Call call);
  template <typename Call>
  const BenchSample& whileItGoesDown(Call call);
  void pump();

  RealtimeRunner& inner_;
  LockstepClock& clock_;
  const BenchSample* first_ = nullptr;  ///< of the first watch(), which starts the loop
};

}  // namespace ballbot
