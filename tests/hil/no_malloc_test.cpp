// The bench's cycle allocates nothing, from the first torque over a fault to the last word.
#include <gtest/gtest.h>

#include "tests/controller/support/allocation_counter.hpp"
#include "tests/hil/support/bench_fixture.hpp"

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

}  // namespace
}  // namespace ballbot
