#pragma once

#include <array>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <semaphore.h>

#include "hil/bench_io.hpp"
#include "hil/bench_runner.hpp"
#include "hil/deadline_schedule.hpp"
#include "hil/jitter_histogram.hpp"
#include "hil/latency/answer_probe.hpp"
#include "hil/latency/loop_times.hpp"
#include "hil/loop_clock.hpp"
#include "hil/realtime_thread.hpp"
#include "hil/recorder/recorded_bus.hpp"
#include "hil/spsc_ring.hpp"

namespace ballbot {

/// Runs a bench in real time, in a thread of its own with absolute deadlines:
///
///   deadline            what came late is put aside; SYNC, then the answers until all are there
///                       or `collect` has passed
///   deadline + act      the newest command goes out
///
/// The thread shares only lock-free queues with the one that commands it. A controller that is late
/// gets the samples of all cycles in order, so that it can catch up; a cycle that the loop itself
/// had to skip has no sample, and the next one stands for it.
class RealtimeRunner final : public BenchRunner {
 public:
  /// @param clock  must outlive this; null: the machine's
  /// @param recorded_s  that the flight recorder keeps
  RealtimeRunner(const BenchConfig& config, std::vector<CanBus*> buses, LoopClock* clock = nullptr,
                 double recorded_s = FlightRecorder::kDefaultSeconds);
  ~RealtimeRunner() override;

  const BenchSample& watch() override;
  void engage() override;
  void command(std::int64_t cycle, const BenchCommand& command) override;
  const BenchSample& sample(std::int64_t cycle) override;
  void release() noexcept override;
  void requireGoodEnd() override;
  bool hasFault() const noexcept override {
    return state_.load(std::memory_order_acquire) == SafetyState::kFault;
  }
  /// Only what does not change while the loop runs, or after it has ended.
  const Bench& bench() const override { return bench_; }
  /// After finish().
  const FlightRecorder& recorder() const override { return recorder_; }
  const BenchIo& io() const { return io_; }

  /// Somebody has asked for the way down, and the loop will see it in its next cycle.
  bool stopAsked() const noexcept { return want_stop_; }
  /// Ends the loop, with the drives off. Afterwards the statistics may be read.
  void finish() noexcept;
  struct Statistics {
    JitterHistogram wake;  ///< from the deadline to the thread running
    JitterHistogram act;   ///< from the deadline to the command on its way to the bus
    LoopTimes times;
    /// Times that so many periods were skipped in a row: index 1, 2, ...; the last stands for more.
    std::array<std::int64_t, 17> misses{};
    std::int64_t cycles = 0, overruns = 0, skipped = 0;
    std::int64_t commands_missing = 0;  ///< cycles with torque that had no new command
    std::int64_t records_lost = 0;
    RealtimeGrant grant;
  };
  const Statistics& statistics() const { return statistics_; }
  const AnswerProbe& answers() const { return answers_; }
  /// Records of all cycles, in order; to be emptied by one thread.
  SpscRing<CycleRecord>& records() { return records_; }

 private:
  struct Sample {
    std::int64_t cycle = 0;
    BenchSample sample;
  };
  void start();
  void loop() noexcept;
  void cycle(std::int64_t deadline_ns) noexcept;
  void takeCommands() noexcept;
  int periodsSinceLast(std::int64_t woke_ns) noexcept;
  bool waitForNews() noexcept;
  void throwIfFault();
  void throwIfStopped();

  LoopClock wall_clock_;
  LoopClock& clock_;
  Bench bench_;
  FlightRecorder recorder_;
  AnswerProbe answers_;
  RecordedBuses recorded_;
  BenchIo io_;
  std::thread thread_;
  SpscRing<BenchCommand> commands_;
  SpscRing<Sample> samples_;
  SpscRing<CycleRecord> records_;
  sem_t news_{};
  std::atomic<bool> running_{false}, want_torque_{false}, want_stop_{false};
  std::atomic<bool> watching_{false};  ///< samples go out though no drive has voltage
  std::atomic<SafetyState> state_{SafetyState::kDisabled};
  std::atomic<bool> engage_refused_{false}, down_{true};

  // Of the loop's thread.
  Bench::Wishes wishes_;
  BenchCommand command_;
  std::int64_t session_cycle_ = -1, command_number_ = 0;
  int skipped_now_ = 0;
  std::int64_t last_woke_ns_ = 0;
  Statistics statistics_;

  // Of the thread that commands.
  Sample last_;
};

}  // namespace ballbot
