#pragma once

#include <vector>

#include "hil/bench_io.hpp"
#include "hil/bench_runner.hpp"

namespace ballbot {

/// Runs a bench whose clock is its own SYNC: nothing happens between two calls, every cycle waits
/// for all answers, and equal commands give equal samples on any machine.
class SteppedRunner final : public BenchRunner {
 public:
  /// The buses must outlive this.
  /// @param patience  for the answers of one cycle; what has not come then counts as missing
  SteppedRunner(const BenchConfig& config, std::vector<CanBus*> buses,
                std::chrono::milliseconds patience = std::chrono::seconds(5));
  ~SteppedRunner() override;

  void engage() override;
  void command(std::int64_t cycle, const BenchCommand& command) override;
  const BenchSample& sample(std::int64_t cycle) override;
  void release() noexcept override;
  const Bench& bench() const override { return bench_; }
  const BenchIo& io() const { return io_; }

 private:
  void sense() noexcept;
  void actuate() noexcept;
  void throwIfFault();

  Bench bench_;
  BenchIo io_;
  std::chrono::milliseconds patience_;
  Bench::Wishes wishes_;
  BenchCommand command_;
  std::int64_t cycle_ = 0;
  bool running_ = false, actuated_ = false;
  bool wants_release_ = false;  ///< drives may have voltage that nobody has taken away yet
};

}  // namespace ballbot
