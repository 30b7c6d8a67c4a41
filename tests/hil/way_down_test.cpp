#include "hil/way_down.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "hil/bring_up.hpp"
#include "tests/hil/support/bench_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Said = WayDown::Said;
using Stage = WayDown::Stage;

std::array<Said, kDriveCount> allSay(Said word) {
  std::array<Said, kDriveCount> said;
  said.fill(word);
  return said;
}

TEST(WayDown, IsConfirmedOnlyByTheWordOfEveryDrive) {
  WayDown w(3);
  w.begin();
  auto said = allSay(Said::kOff);
  said[4] = Said::kOn;
  w.step(said);
  EXPECT_FALSE(w.confirmed());
  EXPECT_TRUE(w.isDoubtful(4));
  EXPECT_FALSE(w.isDoubtful(3));
  said[4] = Said::kNothing;
  w.step(said);
  EXPECT_FALSE(w.confirmed()) << "silence confirms nothing";
  said[4] = Said::kOff;
  w.step(said);
  EXPECT_TRUE(w.confirmed());
}

TEST(WayDown, GoesFromDisableOverQuickStopAndDisableToNmtStopAndGivesUp) {
  WayDown w(3);
  w.begin();
  std::vector<Stage> seen;
  int stops = 0, pre_operational = 0, steps = 0;
  while (!w.over() && steps < 1000) {
    w.step(allSay(Said::kOn));
    ++steps;
    if (seen.empty() || seen.back() != w.stage(2)) seen.push_back(w.stage(2));
    const WayDown::Order& order = w.order(2);
    EXPECT_EQ(order.goal,
              w.stage(2) == Stage::kQuickStop ? DriveGoal::kQuickStop : DriveGoal::kVoltageOff);
    stops += order.nmt_stop ? 1 : 0;
    pre_operational += order.nmt_pre_operational ? 1 : 0;
  }
  EXPECT_EQ(seen, (std::vector<Stage>{Stage::kDisable, Stage::kQuickStop, Stage::kDisableAgain,
                                      Stage::kNmtStop, Stage::kGivenUp}));
  EXPECT_EQ(stops, 1);
  EXPECT_EQ(pre_operational, 1) << "where its statusword can be asked for by SDO";
  EXPECT_LE(steps, w.longest());
  EXPECT_FALSE(w.confirmed());
}

TEST(WayDown, BeginsAnewForADriveThatTakesItsWordBack) {
  WayDown w(3);
  w.begin();
  w.step(allSay(Said::kOff));
  ASSERT_TRUE(w.confirmed());
  w.step(allSay(Said::kNothing));
  EXPECT_TRUE(w.confirmed()) << "silence takes nothing back";
  w.step(allSay(Said::kOn));
  EXPECT_FALSE(w.confirmed());
  EXPECT_EQ(w.stage(0), Stage::kDisable);
}

TEST(WayDown, OnlyStatesWithoutPowerInTheMotorAreOff) {
  EXPECT_EQ(WayDown::saidBy(DriveState::kSwitchOnDisabled), Said::kOff);
  EXPECT_EQ(WayDown::saidBy(DriveState::kFault), Said::kOff);
  EXPECT_EQ(WayDown::saidBy(DriveState::kSwitchedOn), Said::kOn);
  EXPECT_EQ(WayDown::saidBy(DriveState::kQuickStopActive), Said::kOn);
  EXPECT_EQ(WayDown::saidBy(DriveState::kFaultReactionActive), Said::kOn);
  EXPECT_EQ(WayDown::saidBy(DriveState::kUnknown), Said::kNothing);
}

/// A bench with torque on that is told to stop.
struct Stopping : BenchFixture {
  using BenchFixture::BenchFixture;
  void follow(int cycles) {
    command.torque.fill(1);
    wishes.command = &command;
    ASSERT_TRUE(engage()) << bench.faultText();
    for (int i = 0; i < cycles; ++i) cycle();
    ASSERT_GT(drives.largestTorque(), 0);
  }
  int goDown() {
    wishes.stop = true;
    for (int i = 0; i < 1000; ++i) {
      cycle();
      if (bench.isDown()) return i;
      EXPECT_FALSE(bench.torqueIsOff());
    }
    return -1;
  }
  BenchCommand command;
};

TEST(BenchWayDown, EndsDisabledOnceEveryDriveHasSaidThatItIsOff) {
  Stopping f;
  f.follow(60);
  EXPECT_GE(f.goDown(), f.config.safety.damping_cycles);
  EXPECT_TRUE(f.bench.torqueIsOff());
  EXPECT_FALSE(f.drives.anyEnergized());
  EXPECT_EQ(f.bench.safety().state(), SafetyState::kDisabled);
  EXPECT_EQ(f.bench.lastWord(), "");
  EXPECT_NO_THROW(requireGoodEnd(f.bench));
}

// Its PDOs are lost, not its SDO server: asked, it says that it is off.
TEST(BenchWayDown, AsksADriveBySdoThatSaysNothingByPdo) {
  Stopping f;
  f.follow(60);
  f.drives.inject({0, EmulatedFault::kPdosLost, 2, 0});
  for (int i = 0; i < 20; ++i) f.cycle();
  EXPECT_EQ(f.bench.safety().fault(), BenchFault::kDriveStale) << f.bench.faultText();
  EXPECT_TRUE(f.bench.torqueIsOff()) << f.bench.lastWord();
  EXPECT_FALSE(f.drives.anyEnergized());
}

TEST(BenchWayDown, NamesTheNodeAndTheSwitchOfADriveThatCannotSaySo) {
  Stopping f("drive_defaults: {off_switch: \"the red lever S1\"}");
  f.follow(60);
  f.drives.inject({0, EmulatedFault::kPowerLoss, 4, 0});
  for (int i = 0; i < 100; ++i) f.cycle();
  EXPECT_TRUE(f.bench.isDown()) << "all that can be done by wire";
  EXPECT_FALSE(f.bench.torqueIsOff());
  EXPECT_THAT(f.bench.lastWord(), HasSubstr("TORQUE MAY STILL BE ON: node 5 (arm 2, bus 1)"));
  EXPECT_THAT(f.bench.lastWord(), HasSubstr("Pull the red lever S1 now"));
  EXPECT_THAT(f.bench.lastWord(), Not(HasSubstr("node 4")));
  try {
    requireGoodEnd(f.bench);
    FAIL() << "nobody has said that the torque is off";
  } catch (const TorqueNotOffError& e) {
    EXPECT_EQ(e.exitCode(), ExitCode::kTorqueNotOff);
    EXPECT_THAT(e.what(), HasSubstr("a drive's PDOs are missing"));
  }
}

}  // namespace
}  // namespace ballbot
