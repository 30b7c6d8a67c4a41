// Malformed, truncated and random frames, a million at each end of the bus: neither the emulated
// nodes nor the master may crash, enable anything, or give torque that nobody asked for.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/hil/support/bench_fixture.hpp"
#include "tests/hil/support/canopen_noise.hpp"

namespace ballbot {
namespace {

constexpr int kFrames = 1'000'000;

/// Whether a frame is an RPDO1 that tells a drive "enable operation".
bool enables(const CanFrame& f) {
  return f.id > 0x200 && f.id < 0x280 && f.size >= 2 && (f.data[0] & 0x0F) == 0x0F;
}

/// Whether a frame is an RPDO1 with a torque in it.
bool hasTorque(const CanFrame& f) {
  return f.id > 0x200 && f.id < 0x280 && (f.data[2] != 0 || f.data[3] != 0);
}

/// A bench whose frames are looked at before they go out.
class WatchedBench : public BenchFixture {
 public:
  explicit WatchedBench(const std::string& extra = "") : BenchFixture(extra) {}

  /// One cycle with noise between the good frames.
  void noisyCycle(CanopenNoise& noise, int frames) {
    BenchMaster& m = bench.master();
    m.beginCycle();
    io->send();
    io->collect(std::chrono::steady_clock::now());
    for (int i = 0; i < frames; ++i) {
      const int bus = noise.bus();
      m.onFrame(bus, noise.fromNode());
      if (m.outbox(bus).size() > FrameQueue::kCapacity / 2) io->send();
    }
    m.endCycle();
    bench.observe();
    bench.actuate(wishes);
    enabling = torque = false;
    for (int b = 0; b < m.busCount(); ++b) {
      for (const CanFrame& f : m.outbox(b)) {
        enabling = enabling || enables(f);
        torque = torque || hasTorque(f);
      }
    }
    io->send();
  }

  bool enabling = false, torque = false;  ///< said in the last cycle
};

TEST(CanopenFuzz, TheEmulatedNodesEnableNothing) {
  BenchFixture f;
  CanopenNoise noise(21);
  std::int64_t answers = 0;
  for (int i = 0; i < kFrames; ++i) {
    const int bus = noise.bus();
    f.drives.onFrame(bus, noise.toNode());
    if (i % 16 == 0) f.drives.onFrame(0, CanFrame{0x080, false, false, 0, {}});
    if (i % 16 == 8) f.drives.onFrame(1, CanFrame{0x080, false, false, 0, {}});
    ASSERT_FALSE(f.drives.anyEnergized()) << "by frame " << i;
    for (int b = 0; b < 2; ++b) {
      for (const CanFrame& out : f.drives.outbox(b)) ASSERT_TRUE(isValid(out));
      answers += static_cast<std::int64_t>(f.drives.outbox(b).size());
      f.drives.outbox(b).clear();
    }
  }
  EXPECT_GT(answers, kFrames / 20) << "much of the noise must get as far as the SDO servers";
}

// The last word before torque is "enable operation". Here everything but that has been said, and
// the noise consists of that word in forms in which it does not count.
TEST(CanopenFuzz, SpoiltEnableCommandsEnableNothing) {
  BenchFixture f;
  ASSERT_TRUE(f.configure());
  f.wishes.prepare = true;
  for (int i = 0; i < 40; ++i) f.cycle();
  ASSERT_EQ(f.bench.safety().state(), SafetyState::kReady) << f.bench.faultText();
  CanopenNoise noise(22);
  for (int i = 0; i < kFrames; ++i) {
    const int node = noise.drive();
    f.drives.onFrame(node > 3 ? 1 : 0, noise.spoiltEnable(node));
    ASSERT_FALSE(f.drives.anyEnergized()) << "by frame " << i;
    for (int b = 0; b < 2; ++b) f.drives.outbox(b).clear();
  }
  CanFrame good{0x201, false, false, 4, {0x0F, 0, 0, 0}};
  f.drives.onFrame(0, good);
  EXPECT_TRUE(f.drives.anyEnergized()) << "or this test could not have failed";
}

TEST(CanopenFuzz, TheMasterEnablesNothingUnlessAsked) {
  CanopenNoise noise(23);
  std::int64_t faults = 0;
  for (int round = 0; round < 500; ++round) {
    WatchedBench f;
    ASSERT_TRUE(f.configure());
    f.wishes.prepare = true;
    for (int i = 0; i < 100; ++i) {
      f.noisyCycle(noise, i < 10 ? 0 : 10);
      ASSERT_FALSE(f.enabling || f.torque) << "round " << round << ", cycle " << i;
    }
    ASSERT_FALSE(f.drives.anyEnergized());
    if (f.bench.safety().state() == SafetyState::kFault) ++faults;
  }
  EXPECT_GT(faults, 250) << "foreign emergencies and heartbeats must have been believed";
}

TEST(CanopenFuzz, NoiseDuringSetUpIsNoSuccess) {
  CanopenNoise noise(24);
  for (int round = 0; round < 300; ++round) {
    WatchedBench f;
    BenchMaster& m = f.bench.master();
    m.reset();
    for (int i = 0; i < 1000; ++i) {
      const int bus = noise.bus();
      m.onFrame(bus, noise.fromNode());
      if (i % 20 != 0) continue;
      m.endCycle();
      for (int b = 0; b < 2; ++b) m.outbox(b).clear();  // no node ever hears a word
      ASSERT_FALSE(m.configured());
    }
  }
}

// With torque on, noise may end the run. It never brings a torque beyond the limit, and after a
// fault there is none.
TEST(CanopenFuzz, WithTorqueOnNoiseCanOnlyEndIt) {
  CanopenNoise noise(25);
  std::int64_t faults = 0;
  for (int round = 0; round < 250; ++round) {
    WatchedBench f("safety: {damping_ms: 0}");
    BenchCommand command;
    command.torque.fill(0.4);
    f.wishes.command = &command;
    ASSERT_TRUE(f.engage()) << f.bench.faultText();
    for (int i = 0; i < 80; ++i) {
      f.noisyCycle(noise, i < 10 ? 0 : 10);
      for (const double torque : f.bench.torque()) {
        ASSERT_TRUE(std::isfinite(torque));
        ASSERT_LE(std::abs(torque), 0.4);
      }
      if (f.bench.safety().state() == SafetyState::kFault) {
        ASSERT_FALSE(f.enabling || f.torque) << "round " << round << ", cycle " << i;
      }
    }
    if (f.bench.safety().state() != SafetyState::kFault) continue;
    ++faults;
    for (int i = 0; i < 10; ++i) f.cycle();
    ASSERT_FALSE(f.drives.anyEnergized()) << f.bench.faultText();
  }
  EXPECT_GT(faults, 100);
}

}  // namespace
}  // namespace ballbot
