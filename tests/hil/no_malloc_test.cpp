// The bench's cycle allocates nothing, from the first torque over a fault to the last word.
#include <gtest/gtest.h>

#include "hil/recorder/recorded_bus.hpp"
#include "tests/hil/support/bench_fixture.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot {
namespace {

/// One cycle in which only the drives may allocate: what they say is fetched before and handed
/// over.
std::int64_t allocationsOfCycle(BenchFixture& f) {
  BenchMaster& master = f.bench.master();
  const std::int64_t before = allocationCount();
  master.beginCycle();
  std::int64_t count = allocationCount() - before;
  f.io->send();  // the drives answer
  CanFrame frame;
  for (int b = 0; b < 2; ++b) {
    while (f.buses[static_cast<std::size_t>(b)]->receive(frame)) {
      const std::int64_t start = allocationCount();
      master.onFrame(b, frame);
      count += allocationCount() - start;
    }
  }
  const std::int64_t rest = allocationCount();
  master.endCycle();
  f.bench.observe();
  ++f.wishes.command_number;
  f.bench.actuate(f.wishes);
  count += allocationCount() - rest;
  f.io->send();
  return count;
}

TEST(BenchCycle, AllocatesNothingWithTorqueOnNorOnTheWayDown) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer brings its own malloc";
  BenchFixture f;
  BenchCommand command;
  command.torque.fill(1);
  f.wishes.command = &command;
  ASSERT_TRUE(f.engage()) << f.bench.faultText();
  std::int64_t count = 0;
  for (int i = 0; i < 400; ++i) count += allocationsOfCycle(f);
  EXPECT_GT(f.bench.parameters().answered(), 20) << "parameters were read back meanwhile";
  ASSERT_EQ(f.bench.safety().state(), SafetyState::kEnabled) << f.bench.faultText();
  f.drives.inject({0, EmulatedFault::kPdosLost, 2, 0});
  for (int i = 0; i < 100; ++i) count += allocationsOfCycle(f);
  EXPECT_EQ(f.bench.safety().state(), SafetyState::kFault);
  EXPECT_EQ(count, 0);
}

/// A bus that always has a frame.
class TalkingBus final : public CanBus {
 public:
  bool send(const CanFrame&) noexcept override { return true; }
  bool receive(CanFrame& out) noexcept override {
    out.id = 0x181;
    return true;
  }
  bool waitReadable(std::chrono::nanoseconds) noexcept override { return true; }
  int descriptor() const noexcept override { return -1; }
  bool isUp() const noexcept override { return true; }
  const CanCounters& counters() const noexcept override { return counters_; }
  std::string describe() const override { return "talking"; }

 private:
  CanCounters counters_;
};

TEST(FlightRecorder, AllocatesNothingWhileItRecordsAlsoBeyondItsCapacity) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer brings its own malloc";
  BenchFixture f;
  ASSERT_TRUE(f.engage()) << f.bench.faultText();
  FlightRecorder recorder(f.config, nullptr, 0.05);
  TalkingBus inner;
  AnswerProbe probe(f.config);
  RecordedBus bus(inner, 0, recorder, &probe);
  CanFrame frame;
  const std::int64_t before = allocationCount();
  for (int cycle = 1; cycle <= 200; ++cycle) {
    recorder.beginCycle(cycle);
    for (int i = 0; i < 20; ++i) {
      bus.receive(frame);
      bus.send(frame);
    }
    probe.endCycle();
    recorder.endCycle(f.bench, f.bench.record());
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_EQ(recorder.frames().pushed(), 8000U);
  EXPECT_EQ(recorder.frames().size(), recorder.frames().capacity()) << "it has overwritten";
}

}  // namespace
}  // namespace ballbot
