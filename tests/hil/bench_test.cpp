#include "hil/bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hil/support/bench_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

TEST(Bench, ConfiguresEnablesAndGivesTorque) {
  BenchFixture f;
  ASSERT_TRUE(f.engage()) << f.bench.faultText();
  BenchCommand command;
  command.torque = {1, -1, 0.5, 2, -2, 0};
  f.wishes.command = &command;
  for (int i = 0; i < 100; ++i) f.cycle();
  EXPECT_EQ(f.bench.safety().state(), SafetyState::kEnabled) << f.bench.faultText();
  EXPECT_DOUBLE_EQ(f.drives.largestTorque(), 2);
  const BenchSample& s = f.bench.master().sample();
  EXPECT_NEAR(s.joint_torque[0], 1, 0.02);
  EXPECT_NEAR(s.joint_torque[4], -2, 0.02);
  EXPECT_GT(s.joint_velocity[0], 0.1);
  EXPECT_GT(s.imu_count, 90);
  EXPECT_NEAR(s.accel[2], 9.81, 0.005);
}

// Up to stale_cycles: one late frame is no reason to drop a robot.
TEST(Bench, GoesOnOverTwoMissingAnswersAndStopsAtTheThird) {
  for (const int missing : {1, 2, 3}) {
    BenchFixture f;
    BenchCommand command;
    command.torque.fill(1);
    f.wishes.command = &command;
    ASSERT_TRUE(f.engage()) << f.bench.faultText();
    for (int i = 0; i < 60; ++i) f.cycle();
    f.drives.inject({0, EmulatedFault::kSyncHeldBack, 4, static_cast<double>(missing)});
    for (int i = 0; i < 6; ++i) {
      f.cycle();
      if (missing == 3) continue;
      EXPECT_EQ(f.drives.largestTorque(), 1) << missing << " missing, cycle " << i;
    }
    EXPECT_EQ(f.bench.safety().state(), missing < 3 ? SafetyState::kEnabled : SafetyState::kFault)
        << f.bench.faultText();
  }
}

TEST(Bench, AWarningIsNoReasonToStop) {
  BenchFixture f;
  BenchCommand command;
  command.torque.fill(1);
  f.wishes.command = &command;
  ASSERT_TRUE(f.engage()) << f.bench.faultText();
  f.drives.inject({0, EmulatedFault::kWarning, 1, 0});
  for (int i = 0; i < 100; ++i) f.cycle();
  EXPECT_TRUE(f.bench.master().drive(1).statusword & kStatusWarning);
  EXPECT_EQ(f.bench.safety().state(), SafetyState::kEnabled) << f.bench.faultText();
}

TEST(Bench, TorqueGrowsFromZeroAfterEngaging) {
  BenchFixture f("safety: {ramp_ms: 100}");
  BenchCommand command;
  command.torque.fill(4);
  f.wishes.command = &command;
  ASSERT_TRUE(f.engage());
  double last = f.bench.torque()[0];
  EXPECT_NEAR(last, 0.1, 1e-9) << "one fortieth";
  for (int i = 0; i < 60; ++i) {
    f.cycle();
    EXPECT_LE(f.bench.torque()[0] - last, 0.1 + 1e-9);
    last = f.bench.torque()[0];
  }
  EXPECT_EQ(last, 4);
}

TEST(Bench, CutsTorqueAndItsRate) {
  BenchFixture f(
      "drive_defaults: {torque_limit_Nm: 3, torque_rate_limit_Nm_per_s: 400, "
      "velocity_limit_rad_per_s: 100}\nsafety: {ramp_ms: 0}");
  BenchCommand command;
  f.wishes.command = &command;
  ASSERT_TRUE(f.engage());
  command.torque.fill(1e6);
  f.cycle();
  EXPECT_DOUBLE_EQ(f.bench.torque()[2], 1) << "400 Nm/s over 2.5 ms";
  for (int i = 0; i < 5; ++i) f.cycle();
  EXPECT_DOUBLE_EQ(f.bench.torque()[2], 3);
  EXPECT_GE(f.bench.saturatedCycles(), 5);
}

TEST(Bench, RefusesToEngageWhatMoves) {
  BenchFixture f;
  ASSERT_TRUE(f.configure());
  f.drives.inject({0, EmulatedFault::kRunaway, 3, 0.5});
  f.wishes.prepare = f.wishes.engage = true;
  for (int i = 0; i < 50; ++i) f.cycle();
  EXPECT_EQ(f.bench.safety().state(), SafetyState::kReady);
  EXPECT_TRUE(f.bench.safety().engageRefused());
}

TEST(Bench, ResetsFaultsFromBeforeOnceWhenPreparing) {
  BenchFixture f;
  ASSERT_TRUE(f.configure());
  f.drives.drive(2).raiseFault(0x3220, 4);
  f.drives.drive(2).clearCause();
  f.drives.drive(2).outbox().clear();
  f.wishes.prepare = true;
  for (int i = 0; i < 20; ++i) f.cycle();
  EXPECT_EQ(f.bench.safety().state(), SafetyState::kReady) << f.bench.faultText();
}

TEST(Bench, TakesSkippedPeriodsForTimeAndNotForAJumpOfTheEncoder) {
  BenchFixture f;
  ASSERT_TRUE(f.engage());
  BenchCommand command;
  command.torque[0] = 2;
  f.wishes.command = &command;
  for (int i = 0; i < 400 && f.bench.master().sample().joint_velocity[0] < 4; ++i) f.cycle();
  const double velocity = f.bench.master().sample().joint_velocity[0];
  ASSERT_GT(velocity, 3.9);
  command.torque[0] = 0;
  // Each time the joint goes three periods further than one period's velocity says.
  const double missed = 3 * f.config.cycleSeconds() * 0.5 * velocity;
  ASSERT_GT(10 * missed, 2 * f.config.safety.encoder_mismatch);
  for (int i = 0; i < 10; ++i) {
    f.cycle(3);
    ASSERT_EQ(f.bench.safety().state(), SafetyState::kEnabled) << i << ": " << f.bench.faultText();
  }
}

struct WrongSetup {
  const char* extra;
  const char* text;
};
class BenchSetup : public ::testing::TestWithParam<WrongSetup> {};

TEST_P(BenchSetup, IsRefusedInWords) {
  BenchFixture f(GetParam().extra);
  EXPECT_FALSE(f.engage());
  f.bench.observe();
  f.bench.actuate({});
  EXPECT_THAT(f.bench.faultText(), HasSubstr(GetParam().text));
  EXPECT_EQ(f.drives.largestTorque(), 0);
}
INSTANTIATE_TEST_SUITE_P(
    Bench, BenchSetup,
    ::testing::Values(
        WrongSetup{"drive_defaults: {rated_torque_Nm: 5}",
                   "node 1: 6076:00 rated torque in mNm is 20000 (0x4e20), configured 5000"},
        WrongSetup{"drive_defaults: {encoder_counts_per_turn: 4096}",
                   "608F:01 encoder increments is 14400"},
        WrongSetup{"drive_defaults: {torque_limit_Nm: 35}",
                   "6072:00 max torque in per mille is 1500 (0x5dc), must be at least 1750"},
        WrongSetup{"imu: {gyro_resolution_rad_per_s: 0.001}",
                   "IMU: node 7: 2004:02 gyro resolution"},
        WrongSetup{"tpdo: [[60410010, 60770010, 60640020], [606C0020], [60760020]]",
                   "1A02:01 PDO mapping: writing refused, 06040041 (object cannot be mapped"}));

// It may be operational again by the time somebody asks.
TEST(NodeLink, SaysForWhichStateANodeLeftOperational) {
  NodeLink link(1, {}, 10, 10);
  FrameQueue out;
  link.expectBootUp(10);
  link.onFrame(heartbeatFrame(1, NmtState::kBootUp), out);
  link.start();
  for (const NmtState state :
       {NmtState::kOperational, NmtState::kPreOperational, NmtState::kOperational}) {
    link.onFrame(heartbeatFrame(1, state), out);
  }
  EXPECT_EQ(link.troubleText(),
            "node 1 left operational by itself: it said that it is pre-operational");
}

TEST(Bench, AMissingNodeIsNamed) {
  BenchFixture f("imu: {node: 9}");
  EXPECT_FALSE(f.engage());
  f.bench.observe();
  f.bench.actuate({});
  EXPECT_THAT(f.bench.faultText(),
              HasSubstr("node 9 does not answer a reset. Is it powered, and is its node-ID 9?"));
}

}  // namespace
}  // namespace ballbot
