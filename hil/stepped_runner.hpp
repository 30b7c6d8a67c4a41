#pragma once

#include <vector>

#include "hil/bench_io.hpp"
#include "hil/bench_runner.hpp"
#include "hil/bring_up.hpp"
#include "hil/recorder/recorded_bus.hpp"

namespace ballbot {

/// Runs a bench whose clock is its own SYNC: nothing happens between two calls, every cycle waits
/// for all answers, and equal commands give equal samples on any machine. For emulated drives: with
/// real ones nothing would watch the time between two steps.
class SteppedRunner final : public BenchRunner {
 public:
  /// The buses must outlive this.
  /// @param recorded_s  that the flight recorder keeps
  /// @param patience  for the answers of one cycle; what has not come then counts as missing. After
  ///                  a cycle with missing ones, and on the way down, the wait is shorter
  SteppedRunner(const BenchConfig& config, std::vector<CanBus*> buses,
                std::chrono::milliseconds patience = std::chrono::seconds(5),
                double recorded_s = FlightRecorder::kDefaultSeconds);
  ~SteppedRunner() override;

  const BenchSample& watch() override;
  void engage() override;
  void command(std::int64_t cycle, const BenchCommand& command) override;
  const BenchSample& sample(std::int64_t cycle) override;
  void release() noexcept override;
  void requireGoodEnd() override { ballbot::requireGoodEnd(bench_); }
  const Bench& bench() const override { return bench_; }
  const FlightRecorder& recorder() const override { return recorder_; }
  const BenchIo& io() const { return io_; }

 private:
  void start();
  void sense() noexcept;
  void actuate() noexcept;
  void throwIfFault();
  void throwIfStopped();
  void goDown() noexcept;
  std::chrono::milliseconds patience() const noexcept;

  Bench bench_;
  FlightRecorder recorder_;
  RecordedBuses recorded_;
  BenchIo io_;
  std::chrono::milliseconds patience_;
  Bench::Wishes wishes_;
  BenchCommand command_;
  std::int64_t command_number_ = 0;
  std::int64_t cycle_ = 0;
  bool running_ = false, actuated_ = false;
  bool answers_missing_ = false;                        ///< in the cycle before
  std::chrono::steady_clock::time_point down_until_{};  ///< set on the way down: its wall-clock end
  bool wants_release_ = false;  ///< drives may have voltage that nobody has taken away yet
};

}  // namespace ballbot
