#include "hil/emulator/drive_node.hpp"

#include <gtest/gtest.h>

#include "hil/cia402.hpp"
#include "tests/hil/support/random_bytes.hpp"
#include "tests/hil/support/sdo_dialogue.hpp"

namespace ballbot {
namespace {

class Drive : public ::testing::Test {
 protected:
  Drive() : drive_({}), talk_(drive_) {
    drive_.powerOn();
    talk_.write(0x6060, 0, 10, 1);
    drive_.onFrame(nmtFrame(NmtCommand::kStart, 1));
    drive_.outbox().clear();
  }
  DriveState command(std::uint16_t word) {
    talk_.write(0x6040, 0, word, 2);
    return state();
  }
  DriveState state() { return driveState(static_cast<std::uint16_t>(*talk_.read(0x6041))); }
  void enable() {
    command(kShutdown);
    command(kSwitchOn);
    ASSERT_EQ(command(kEnableOperation), DriveState::kOperationEnabled);
  }
  DriveNode drive_;
  SdoDialogue talk_;
};

TEST_F(Drive, GoesUpAndDownTheStateMachine) {
  EXPECT_EQ(state(), DriveState::kSwitchOnDisabled);
  EXPECT_EQ(command(kEnableOperation), DriveState::kSwitchOnDisabled) << "no step left out";
  EXPECT_EQ(command(kSwitchOn), DriveState::kSwitchOnDisabled);
  EXPECT_EQ(command(kShutdown), DriveState::kReadyToSwitchOn);
  EXPECT_EQ(command(kSwitchOn), DriveState::kSwitchedOn);
  EXPECT_EQ(command(kEnableOperation), DriveState::kOperationEnabled);
  EXPECT_EQ(command(kSwitchOn), DriveState::kSwitchedOn);
  EXPECT_EQ(command(kShutdown), DriveState::kReadyToSwitchOn);
  EXPECT_EQ(command(kDisableVoltage), DriveState::kSwitchOnDisabled);
  enable();
  EXPECT_EQ(command(kShutdown), DriveState::kReadyToSwitchOn);
  command(kSwitchOn);
  EXPECT_EQ(command(kQuickStopCommand), DriveState::kSwitchOnDisabled);
}

TEST_F(Drive, GivesTorqueOnlyWhenEnabledAndWithinItsOwnLimit) {
  talk_.write(0x6071, 0, 100, 2);
  EXPECT_EQ(drive_.output(0).torque, 0);
  enable();
  EXPECT_DOUBLE_EQ(drive_.output(0).torque, 2.0) << "100 per mille of 20 Nm";
  talk_.write(0x6072, 0, 50, 2);
  EXPECT_DOUBLE_EQ(drive_.output(0).torque, 1.0);
  EXPECT_NE(*talk_.read(0x6041) & kStatusInternalLimit, 0);
  EXPECT_EQ(*talk_.read(0x6074), 50);
  command(kDisableVoltage);
  EXPECT_EQ(drive_.output(0).torque, 0);
}

TEST_F(Drive, QuickStopRampsDownAndEndsAsItsOptionSays) {
  enable();
  talk_.write(0x6071, 0, 1000, 2);
  EXPECT_EQ(drive_.output(0).torque, 20);
  EXPECT_EQ(command(kQuickStopCommand), DriveState::kQuickStopActive);
  EXPECT_DOUBLE_EQ(drive_.output(5'000'000).torque, 10) << "slope of 100 per mille a millisecond";
  EXPECT_EQ(drive_.output(10'000'000).torque, 0);
  EXPECT_EQ(state(), DriveState::kSwitchOnDisabled);
  talk_.write(0x605A, 0, 6, 2);
  enable();
  EXPECT_EQ(command(kQuickStopCommand), DriveState::kQuickStopActive);
  drive_.output(1'000'000'000);
  EXPECT_EQ(state(), DriveState::kQuickStopActive) << "option 6 stays";
  EXPECT_EQ(command(kEnableOperation), DriveState::kOperationEnabled) << "transition 16";
}

TEST_F(Drive, AFaultIsAnnouncedAndStaysUntilARisingEdge) {
  enable();
  drive_.raiseFault(0x4310, 0x08);
  ASSERT_EQ(drive_.outbox().size(), 1U);
  EXPECT_EQ(drive_.outbox()[0], (CanFrame{0x81, false, false, 8, {0x10, 0x43, 0x89}}));
  EXPECT_EQ(state(), DriveState::kFaultReactionActive);
  EXPECT_EQ(drive_.output(20'000'000).torque, 0);
  EXPECT_EQ(state(), DriveState::kFault);
  EXPECT_EQ(*talk_.read(0x603F), 0x4310);
  EXPECT_EQ(command(kFaultReset), DriveState::kFault) << "the cause is still there";
  drive_.clearCause();
  EXPECT_EQ(command(kFaultReset), DriveState::kFault) << "no edge";
  command(kDisableVoltage);
  EXPECT_EQ(command(kFaultReset), DriveState::kSwitchOnDisabled);
  EXPECT_EQ(*talk_.read(0x603F), 0);
}

TEST_F(Drive, LosesItsTorqueWhenItLeavesOperational) {
  for (const NmtCommand way : {NmtCommand::kPreOperational, NmtCommand::kStop,
                               NmtCommand::kResetNode, NmtCommand::kResetCommunication}) {
    talk_.write(0x6060, 0, 10, 1);
    enable();
    talk_.write(0x6071, 0, 100, 2);
    EXPECT_NE(drive_.output(0).torque, 0);
    drive_.onFrame(nmtFrame(way, 1));
    EXPECT_EQ(drive_.output(1'000'000'000).torque, 0) << static_cast<int>(way);
    drive_.onFrame(nmtFrame(NmtCommand::kResetNode, 1));
    drive_.onFrame(nmtFrame(NmtCommand::kStart, 1));
  }
}

TEST_F(Drive, PositionModeHandsTheWholeLawToTheJoint) {
  talk_.write(0x6060, 0, 8, 1);
  talk_.write(0x2010, 1, 8000, 4);
  talk_.write(0x2010, 2, 600, 4);
  enable();
  talk_.write(0x607A, 0, 14400, 4);
  talk_.write(0x60B1, 0, -14400, 4);
  talk_.write(0x60B2, 0, 50, 2);
  const DriveOutput out = drive_.output(0);
  EXPECT_NEAR(out.position, 6.283185307, 1e-9);
  EXPECT_NEAR(out.velocity, -6.283185307, 1e-9);
  EXPECT_DOUBLE_EQ(out.torque, 1);
  EXPECT_DOUBLE_EQ(out.stiffness, 8);
  EXPECT_DOUBLE_EQ(out.damping, 0.6);
}

TEST_F(Drive, SignAndOffsetTurnBothWays) {
  EmulatedDriveParameters p;
  p.sign = -1;
  p.offset = 0.5;
  DriveNode drive(p);
  SdoDialogue talk(drive);
  drive.powerOn();
  drive.setFeedback({1.5, 1.5, 2, 4});
  EXPECT_EQ(static_cast<std::int32_t>(*talk.read(0x6064)), -2292);
  EXPECT_EQ(static_cast<std::int16_t>(*talk.read(0x6077)), -200);
}

// Half a million random frames at a drive that is not commanded: it must neither crash nor give
// torque.
TEST(DriveFuzz, RandomFramesEnableNothing) {
  RandomBytes random(7);
  DriveNode drive({});
  drive.powerOn();
  for (std::int64_t i = 0; i < 500'000; ++i) {
    CanFrame f = random.frame();
    // Aimed: most frames hit an identifier that means something, but never the way up in full.
    const std::uint32_t aims[] = {0x000, 0x080, 0x081, 0x201, 0x301, 0x401, 0x601, 0x701, 0x77F};
    if (random.below(4) != 0) {
      f.id = aims[random.below(9)];
      f.extended = false;
    }
    const bool controlword = f.id == 0x201 || f.id == 0x301 || f.id == 0x601;
    if (controlword && !f.remote)
      f.data[0] &= 0xF0;  // bits 0 to 3 clear: never an enabling command
    drive.onFrame(f);
    if (random.below(50) == 0) drive.onSync();
    if (random.below(50) == 0) drive.onTime(i * 10'000);
    ASSERT_FALSE(drive.enabled());
    ASSERT_EQ(drive.output(i * 10'000).torque, 0);
    drive.outbox().clear();
  }
}

}  // namespace
}  // namespace ballbot
