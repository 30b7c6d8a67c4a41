// The master's view of the drive state machine, over all statuswords and against a drive.
#include "hil/cia402.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(Cia402, EveryStatuswordHasAtMostOneStateAndOnlyItsOwnBitsDecide) {
  constexpr std::uint16_t kStateBits = 0x6F;
  std::map<DriveState, int> seen;
  for (unsigned word = 0; word <= 0xFFFF; ++word) {
    const auto status = static_cast<std::uint16_t>(word);
    const DriveState state = driveState(status);
    ++seen[state];
    ASSERT_EQ(state, driveState(status & kStateBits)) << "bits 4, 7 to 15 are no state";
    // CiA 402: enabled means bits 0, 1, 2, 5 set and 3, 6 clear. Anything else must not be.
    ASSERT_EQ(state == DriveState::kOperationEnabled, (status & 0x6F) == 0x27) << word;
    // Bit 3 is set in the fault states only.
    if ((status & 0x08) != 0) {
      ASSERT_TRUE(state == DriveState::kFault || state == DriveState::kFaultReactionActive ||
                  state == DriveState::kUnknown);
    }
  }
  // A mask of six bits leaves 2^10 words to a pattern, one of five 2^11.
  EXPECT_EQ(seen[DriveState::kOperationEnabled], 1024);
  EXPECT_EQ(seen[DriveState::kReadyToSwitchOn], 1024);
  EXPECT_EQ(seen[DriveState::kSwitchedOn], 1024);
  EXPECT_EQ(seen[DriveState::kQuickStopActive], 1024);
  EXPECT_EQ(seen[DriveState::kSwitchOnDisabled], 2048);
  EXPECT_EQ(seen[DriveState::kNotReadyToSwitchOn], 2048);
  EXPECT_EQ(seen[DriveState::kFault], 2048);
  EXPECT_EQ(seen[DriveState::kFaultReactionActive], 2048);
}

constexpr DriveGoal kGoals[] = {DriveGoal::kVoltageOff, DriveGoal::kSwitchedOn, DriveGoal::kEnabled,
                                DriveGoal::kQuickStop};

// While no statusword comes nothing is confirmed: no way up, but always a way down.
TEST(DrivePowerSequence, HoldsWhatItSaidLastUnlessTheGoalIsLower) {
  DrivePowerSequence p;
  p.setGoal(DriveGoal::kEnabled);
  EXPECT_EQ(p.hold(), kDisableVoltage);
  EXPECT_EQ(p.next(0x0240), kShutdown);
  EXPECT_EQ(p.hold(), kShutdown);
  EXPECT_EQ(p.next(0x0221), kSwitchOn);
  EXPECT_EQ(p.next(0x0223), kEnableOperation);
  EXPECT_EQ(p.next(0x0227), kEnableOperation);
  EXPECT_EQ(p.hold(), kEnableOperation);
  EXPECT_EQ(p.state(), DriveState::kOperationEnabled);
  p.setGoal(DriveGoal::kSwitchedOn);
  EXPECT_EQ(p.hold(), kSwitchOn);
  p.next(0x0227);
  p.setGoal(DriveGoal::kVoltageOff);
  EXPECT_EQ(p.hold(), kDisableVoltage);
  p.setGoal(DriveGoal::kEnabled);
  EXPECT_EQ(p.hold(), kDisableVoltage) << "not back up without a statusword";
}

TEST(DrivePowerSequence, CommandsAtMostTheNextTransitionForEveryStatuswordAndGoal) {
  // Which commands CiA 402 lets follow a state on the way up; disable voltage is always allowed.
  const std::map<DriveState, std::set<int>> allowed = {
      {DriveState::kSwitchOnDisabled, {kShutdown}},
      {DriveState::kReadyToSwitchOn, {kSwitchOn}},
      {DriveState::kSwitchedOn, {kSwitchOn, kEnableOperation}},
      {DriveState::kOperationEnabled, {kSwitchOn, kEnableOperation, kQuickStopCommand}},
      {DriveState::kQuickStopActive, {kQuickStopCommand}},
  };
  for (const DriveGoal goal : kGoals) {
    for (unsigned word = 0; word <= 0xFFFF; ++word) {
      DrivePowerSequence sequence;
      sequence.setGoal(goal);
      const std::uint16_t command = sequence.next(static_cast<std::uint16_t>(word));
      if (command == kDisableVoltage) continue;
      const auto it = allowed.find(driveState(static_cast<std::uint16_t>(word)));
      ASSERT_TRUE(it != allowed.end() && it->second.count(command) == 1)
          << "goal " << static_cast<int>(goal) << " status " << word << " command " << command;
      if (command == kEnableOperation) {
        ASSERT_EQ(goal, DriveGoal::kEnabled);
      }
    }
  }
}

TEST(DrivePowerSequence, WalksUpOneConfirmedTransitionAtATime) {
  DrivePowerSequence s;
  s.setGoal(DriveGoal::kEnabled);
  EXPECT_EQ(s.next(0x0250), kShutdown);
  EXPECT_EQ(s.next(0x0250), kShutdown) << "not confirmed yet";
  EXPECT_EQ(s.waited(), 1);
  EXPECT_EQ(s.next(0x0231), kSwitchOn);
  EXPECT_EQ(s.next(0x0233), kEnableOperation);
  EXPECT_FALSE(s.atGoal());
  EXPECT_EQ(s.next(0x1237), kEnableOperation);
  EXPECT_TRUE(s.atGoal());
  s.setGoal(DriveGoal::kQuickStop);
  EXPECT_EQ(s.next(0x1237), kQuickStopCommand);
  EXPECT_EQ(s.next(0x0217), kQuickStopCommand);
  EXPECT_TRUE(s.atGoal());
  s.setGoal(DriveGoal::kVoltageOff);
  EXPECT_EQ(s.next(0x0217), kDisableVoltage);
}

TEST(DrivePowerSequence, LeavesAFaultOnlyOnRequestAndWithARisingEdge) {
  DrivePowerSequence s;
  s.setGoal(DriveGoal::kEnabled);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(s.next(0x0218), kDisableVoltage) << "no automatic restart";
  s.resetFault();
  EXPECT_EQ(s.next(0x0218), kDisableVoltage) << "bit 7 low first";
  EXPECT_EQ(s.next(0x0218), kFaultReset);
  EXPECT_EQ(s.next(0x0218), kFaultReset);
  EXPECT_EQ(s.next(0x0250), kShutdown);
  EXPECT_FALSE(s.resetPending());
  for (int i = 0; i < 20; ++i) EXPECT_EQ(s.next(0x0218), kDisableVoltage) << "one reset, one try";
}

TEST(DrivePowerSequence, GivesUpAResetThatDoesNotHelp) {
  DrivePowerSequence s;
  s.resetFault();
  int raised = 0;
  for (int i = 0; i < 50; ++i) raised += s.next(0x0218) == kFaultReset ? 1 : 0;
  EXPECT_GT(raised, 1);
  EXPECT_LT(raised, 20);
  EXPECT_FALSE(s.resetPending());
}

}  // namespace
}  // namespace ballbot
