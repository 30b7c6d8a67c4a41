// What the co-simulation is told of a bench's samples, by a runner that says exactly which they
// are.
#include "hil/hil_participant.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

/// A loop by the wall clock that has let periods pass: its master counts none of them.
class LateRunner final : public BenchRunner {
 public:
  /// @param skips  periods skipped before each sample after the first
  explicit LateRunner(std::vector<int> skips)
      : bench_(readBenchConfig(
            parseYaml("{buses: [{address: none}], drives: [{node: 1}, {node: 2}, {node: 3}, "
                      "{node: 4}, {node: 5}, {node: 6}]}",
                      "late"))),
        skips_(std::move(skips)) {}

  const BenchSample& watch() override { return sample_; }
  void engage() override { hear(); }
  void command(std::int64_t, const BenchCommand&) override {}
  const BenchSample& sample(std::int64_t cycle) override {
    while (reached_ < cycle) {
      reached_ += 1 + skips_.at(next_++);
      hear();
    }
    return sample_;
  }
  void release() noexcept override {}
  void requireGoodEnd() override {}
  const Bench& bench() const override { return bench_; }
  const FlightRecorder& recorder() const override { throw std::logic_error("no records here"); }

  bool imu_is_silent = false;

 private:
  void hear() {
    ++sample_.cycle;
    if (imu_is_silent) return;
    ++sample_.imu_count;
    sample_.imu_cycle = sample_.cycle;
  }
  Bench bench_;
  std::vector<int> skips_;
  std::size_t next_ = 0;
  std::int64_t reached_ = 0;
  BenchSample sample_;
};

TEST(HilParticipant, StampsTheImuByItsAgeHoweverManyPeriodsWereSkipped) {
  LateRunner runner({0, 4, 0, 2, 0});
  HilParticipant bench(runner);
  const SimDuration period = runner.bench().config().cycle;
  bench.enterInitializationMode(kSimStart);
  const std::int64_t reached[] = {1, 6, 7, 10};
  for (const std::int64_t cycle : reached) {
    const SimTime before = bench.sensors().time;
    const SimTime now = kSimStart + cycle * period;
    bench.doStep(before, now - before, {});
    EXPECT_EQ(bench.sensors().time, now);
    EXPECT_EQ(bench.sensors().imu_time, now) << "fresh in cycle " << cycle;
  }
  runner.imu_is_silent = true;
  const SimTime last = bench.sensors().time;
  bench.doStep(last, period, {});
  EXPECT_EQ(bench.sensors().imu_time, last) << "a sample of the cycle before";
}

}  // namespace
}  // namespace ballbot
