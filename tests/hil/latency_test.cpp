#include <thread>

#include <gtest/gtest.h>

#include "hil/canopen_codec.hpp"
#include "hil/latency/answer_probe.hpp"
#include "hil/latency/kernel_floor.hpp"
#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kUs = 1000;

CanFrame dataFrame(std::uint32_t id, std::uint8_t size) {
  CanFrame f;
  f.id = id;
  f.size = size;
  return f;
}

/// A bus that carries a frame at a time, bits at 1 Mbit/s, as a master would see it.
class ModelBus {
 public:
  explicit ModelBus(AnswerProbe& probe) : probe_(probe) {}
  void sync(std::int64_t at_ns) {
    time_ = at_ns;
    probe_.onFrame(at_ns, 1, syncFrame(), true);
    carry(syncFrame());
  }
  /// A node's three PDOs after `wait_ns` of its own; all is seen `adapter_ns` later.
  void answer(std::uint32_t node, std::int64_t wait_ns, std::int64_t adapter_ns, int pdos = 3) {
    time_ += wait_ns;
    for (int i = 0; i < pdos; ++i) {
      const CanFrame f = dataFrame(kCobTpdo[static_cast<std::size_t>(i)] + node, i == 2 ? 2 : 8);
      carry(f);
      probe_.onFrame(time_ + adapter_ns, 1, f, false);
    }
  }
  std::int64_t time() const { return time_; }

 private:
  void carry(const CanFrame& f) { time_ += bitsOf(f).nominal.slow * kUs; }
  AnswerProbe& probe_;
  std::int64_t time_ = 0;
};

// Bus 1 of the rehearsal: nodes 4, 5 and 6, nothing else.
TEST(AnswerProbe, SplitsAnAnswerIntoWireSharedAndOwn) {
  AnswerProbe probe(Rehearsal::defaultConfig());
  ModelBus bus(probe);
  constexpr std::int64_t kAdapter = 150 * kUs, kSlow = 90 * kUs;
  for (int cycle = 1; cycle <= 100; ++cycle) {
    bus.sync(cycle * 2500 * kUs);
    bus.answer(4, 0, kAdapter);
    bus.answer(5, 0, kAdapter);
    bus.answer(6, kSlow, kAdapter);
    probe.endCycle();
  }
  const AnswerProbe::Bus& b = probe.buses()[1];
  EXPECT_TRUE(b.has_wire);
  // SYNC, and of each drive two PDOs of 8 bytes and one of 2: 47 + 3 (111 + 111 + 63) bits.
  EXPECT_EQ(b.wire.max(), 902 * kUs);
  EXPECT_EQ(b.answers.max(), 902 * kUs + kAdapter + kSlow);
  EXPECT_EQ(b.answers.count(), 100);
  EXPECT_EQ(b.shared.max(), kAdapter);
  EXPECT_EQ(probe.nodes()[3].own.max(), 0);
  EXPECT_EQ(probe.nodes()[4].own.max(), 0);
  EXPECT_EQ(probe.nodes()[5].own.max(), kSlow);
  EXPECT_EQ(probe.buses()[0].answers.count(), 0) << "nobody spoke there";
}

TEST(AnswerProbe, LeavesOutWhatDidNotComeWholeOrInTime) {
  AnswerProbe probe(Rehearsal::defaultConfig());
  ModelBus bus(probe);
  bus.sync(2500 * kUs);
  bus.answer(4, 0, 0);
  bus.answer(5, 0, 0, 2);  // its third PDO is missing
  probe.endCycle();
  bus.answer(6, 0, 0);  // too late
  EXPECT_EQ(probe.nodes()[3].answer.count(), 1);
  EXPECT_EQ(probe.nodes()[4].answer.count(), 0);
  EXPECT_EQ(probe.nodes()[5].answer.count(), 0);
  EXPECT_EQ(probe.buses()[1].answers.count(), 0) << "not all answers of the bus came";
  EXPECT_EQ(probe.buses()[1].shared.count(), 1);
}

TEST(AnswerProbe, TakesNothingOffWhereThereIsNoWire) {
  AnswerProbe probe(Rehearsal::defaultConfig());
  for (int cycle = 1; cycle <= 10; ++cycle) {
    const std::int64_t at = cycle * 2500 * kUs;
    probe.onFrame(at, 1, syncFrame(), true);
    for (std::uint32_t node = 4; node <= 6; ++node) {
      for (std::size_t i = 0; i < 3; ++i) {
        probe.onFrame(at + 20 * kUs * node, 1, dataFrame(kCobTpdo[i] + node, 8), false);
      }
    }
    probe.endCycle();
  }
  EXPECT_FALSE(probe.buses()[1].has_wire);
  EXPECT_EQ(probe.buses()[1].shared.max(), 80 * kUs);
  EXPECT_EQ(probe.nodes()[5].own.max(), 40 * kUs);
}

TEST(JitterHistogram, AddsAnother) {
  JitterHistogram a, b;
  a.add(5 * kUs);
  b.add(7 * kUs);
  b.add(3'000 * kUs);
  a.add(b);
  EXPECT_EQ(a.count(), 3);
  EXPECT_EQ(a.max(), 3'000 * kUs);
  EXPECT_EQ(a.between(5 * kUs, 8 * kUs), 2);
}

// How late is the machine's; that it is counted once per period is not.
TEST(KernelFloor, CountsItsWakeUpsAndEndsWhenToldTo) {
  FloorSettings settings;
  settings.realtime = false;
  KernelFloor floor(settings);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const KernelFloor::Result& result = floor.finish();
  EXPECT_GT(result.late.count(), 1);
  EXPECT_FALSE(result.grant.fifo);
  const std::atomic<bool> stop{true};
  const auto begun = std::chrono::steady_clock::now();
  measureFloor(settings, 3600, &stop);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60));
}

}  // namespace
}  // namespace ballbot
