// What CiA 301 asks of a node, asked of the emulated ones.
#include "hil/emulator/canopen_node.hpp"

#include <gtest/gtest.h>

#include "hil/emulator/drive_node.hpp"
#include "tests/hil/support/sdo_dialogue.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kMs = 1'000'000;

class Node : public ::testing::Test {
 protected:
  Node() : drive_(parameters()), talk_(drive_) { drive_.powerOn(); }
  static EmulatedDriveParameters parameters() {
    EmulatedDriveParameters p;
    p.node = 5;
    return p;
  }
  std::vector<CanFrame> said() {
    std::vector<CanFrame> frames;
    frames.swap(drive_.outbox());
    return frames;
  }
  std::vector<CanFrame> emergencies() {
    std::vector<CanFrame> frames;
    for (const CanFrame& f : said()) {
      if (f.id == 0x85) frames.push_back(f);
    }
    return frames;
  }
  void nmt(NmtCommand command, int node) { drive_.onFrame(nmtFrame(command, node)); }
  void time(std::int64_t ms) { drive_.onTime(ms * kMs); }
  DriveNode drive_;
  SdoDialogue talk_;
};

TEST_F(Node, AnnouncesItselfWithTheBootUpMessage) {
  EXPECT_EQ(said(), std::vector<CanFrame>{(CanFrame{0x705, false, false, 1, {0}})});
  nmt(NmtCommand::kResetNode, 0);
  EXPECT_EQ(said(), std::vector<CanFrame>{(CanFrame{0x705, false, false, 1, {0}})});
  nmt(NmtCommand::kResetCommunication, 5);
  EXPECT_EQ(said(), std::vector<CanFrame>{(CanFrame{0x705, false, false, 1, {0}})});
  nmt(NmtCommand::kResetNode, 4);
  EXPECT_TRUE(said().empty()) << "another node was meant";
}

TEST_F(Node, HeartbeatShowsTheStateAtItsPeriod) {
  said();
  EXPECT_EQ(talk_.write(0x1017, 0, 100, 2), 0U);
  std::vector<std::uint8_t> states;
  for (int ms = 0; ms < 1000; ++ms) {
    if (ms == 250) nmt(NmtCommand::kStart, 5);
    if (ms == 550) nmt(NmtCommand::kStop, 0);
    time(ms);
    for (const CanFrame& f : said()) {
      if (f.id == 0x705) states.push_back(f.data[0]);
    }
  }
  EXPECT_EQ(states, (std::vector<std::uint8_t>{0x7F, 0x7F, 0x7F, 5, 5, 5, 4, 4, 4, 4}));
}

TEST_F(Node, StoppedNodesTalkToNobodyButTheNetworkManager) {
  nmt(NmtCommand::kStop, 5);
  said();
  drive_.onFrame({0x605, false, false, 8, {0x40, 0, 0x10, 0}});
  drive_.onSync();
  drive_.raiseFault(0x2310, 2);
  EXPECT_TRUE(said().empty());
}

TEST_F(Node, PdosFlowOnlyInOperational) {
  said();
  drive_.onSync();
  EXPECT_TRUE(said().empty());
  nmt(NmtCommand::kStart, 0);
  drive_.onSync();
  const auto frames = said();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].id, 0x185U);
  EXPECT_EQ(frames[0].size, 8);
  EXPECT_EQ(frames[1].id, 0x285U);
  EXPECT_EQ(frames[1].size, 4);
}

TEST_F(Node, TransmissionTypesDecideWhenAPdoIsSent) {
  EXPECT_EQ(talk_.write(0x1801, 2, 3, 1), 0U);  // every third SYNC
  EXPECT_EQ(talk_.write(0x1800, 2, 0, 1), 0U);  // at a SYNC after a change
  EXPECT_EQ(talk_.write(0x1800, 2, 241, 1), 0x06090030U) << "reserved";
  nmt(NmtCommand::kStart, 5);
  said();
  std::string seen;
  for (int i = 0; i < 7; ++i) {
    if (i == 4) drive_.setFeedback({1, 1, 0, 0});
    drive_.onSync();
    for (const CanFrame& f : said()) seen += f.id == 0x185 ? 'a' : 'b';
    seen += '.';
  }
  EXPECT_EQ(seen, "a..b..a.b..");
}

TEST_F(Node, EventDrivenPdosKeepTheirTimers) {
  EXPECT_EQ(talk_.write(0x1802, 5, 50, 2), 0U);
  EXPECT_EQ(talk_.write(0x1802, 3, 100, 2), 0x06010000U) << "inhibit time of a PDO in use";
  nmt(NmtCommand::kStart, 5);
  said();
  int sent = 0;
  for (int ms = 0; ms <= 200; ++ms) {
    time(ms);
    for (const CanFrame& f : said()) sent += f.id == 0x385 ? 1 : 0;
  }
  EXPECT_EQ(sent, 5) << "once for the first value, then every 50 ms";
}

TEST_F(Node, RemappingNeedsThePdoSwitchedOffAndTheCountAtZero) {
  const std::int64_t off = 0xC0000185, on = 0x40000185;
  EXPECT_EQ(talk_.write(0x1A00, 0, 0, 1), 0x06010000U) << "still in use";
  EXPECT_EQ(talk_.write(0x1800, 1, off, 4), 0U);
  EXPECT_EQ(talk_.write(0x1A00, 1, 0x60640020, 4), 0x06010000U) << "count is not zero";
  EXPECT_EQ(talk_.write(0x1A00, 0, 0, 1), 0U);
  EXPECT_EQ(talk_.write(0x1A00, 1, 0x60640020, 4), 0U);
  EXPECT_EQ(talk_.write(0x1A00, 2, 0x60760020, 4), 0x06040041U) << "rated torque cannot be mapped";
  EXPECT_EQ(talk_.write(0x1A00, 2, 0x29990020, 4), 0x06020000U);
  EXPECT_EQ(talk_.write(0x1A00, 2, 0x60640010, 4), 0x06040042U) << "16 bits of 32";
  EXPECT_EQ(talk_.write(0x1A00, 2, 0x606C0020, 4), 0U);
  EXPECT_EQ(talk_.write(0x1A00, 3, 0x60410010, 4), 0U);
  EXPECT_EQ(talk_.write(0x1A00, 0, 3, 1), 0x06040042U) << "80 bits";
  EXPECT_EQ(talk_.write(0x1A00, 0, 2, 1), 0U);
  EXPECT_EQ(talk_.write(0x1800, 1, on, 4), 0U);
  EXPECT_EQ(talk_.write(0x1800, 1, on + 1, 4), 0x06090030U) << "identifier of a PDO in use";
  drive_.setFeedback({1.0, 1.0, 2.0, 0});
  nmt(NmtCommand::kStart, 5);
  said();
  drive_.onSync();
  const CanFrame f = said().front();
  EXPECT_EQ(getSigned(&f.data[0], 4), 2292) << "1 rad of 14400 counts a turn";
  EXPECT_EQ(getSigned(&f.data[4], 4), 4584);
}

TEST_F(Node, SynchronousReceivePdosActAtTheNextSync) {
  EXPECT_EQ(talk_.write(0x1400, 2, 1, 1), 0U);
  nmt(NmtCommand::kStart, 5);
  drive_.onFrame({0x205, false, false, 4, {0x06, 0, 0x64, 0}});
  EXPECT_EQ(drive_.dictionary().value(0x6071), 0);
  drive_.onSync();
  EXPECT_EQ(drive_.dictionary().value(0x6071), 100);
  EXPECT_EQ(talk_.write(0x1400, 2, 255, 1), 0U);
  drive_.onFrame({0x205, false, false, 4, {0x06, 0, 0x9C, 0xFF}});
  EXPECT_EQ(drive_.dictionary().value(0x6071), -100);
}

TEST_F(Node, WrongPdoLengthsAreEmergencies) {
  nmt(NmtCommand::kStart, 5);
  said();
  drive_.onFrame({0x205, false, false, 3, {0x06, 0, 0x64}});
  auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0], (CanFrame{0x85, false, false, 8, {0x10, 0x82, 0x11}}));
  EXPECT_EQ(drive_.dictionary().value(0x6071), 0) << "too short is not processed";
  drive_.onFrame({0x205, false, false, 5, {0x06, 0, 0x64, 0, 1}});
  frames = said();
  EXPECT_EQ(frames.front().data[0], 0x20);
  EXPECT_EQ(drive_.dictionary().value(0x6071), 100) << "too long: the first bytes count";
  EXPECT_EQ(talk_.read(0x1003), 2);
  EXPECT_EQ(talk_.read(0x1003, 1), 0x8220) << "the newest first";
}

TEST_F(Node, ASilentMasterIsAnEmergencyAndLeadsOutOfOperational) {
  EXPECT_EQ(talk_.write(0x1016, 1, 0x007F0014, 4), 0U);  // node 127, 20 ms
  nmt(NmtCommand::kStart, 5);
  said();
  time(500);
  EXPECT_TRUE(emergencies().empty()) << "watched from the first heartbeat on";
  drive_.onFrame(heartbeatFrame(127, NmtState::kOperational));
  time(520);
  EXPECT_TRUE(emergencies().empty());
  time(521);
  const auto frames = emergencies();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].data[0], 0x30);
  EXPECT_EQ(frames[0].data[1], 0x81);
  EXPECT_FALSE(drive_.operational()) << "1029:01 is 0";
}

TEST_F(Node, ReceivePdosThatStopAreAnEmergency) {
  EXPECT_EQ(talk_.write(0x1400, 5, 10, 2), 0U);
  nmt(NmtCommand::kStart, 5);
  said();
  drive_.onFrame({0x205, false, false, 4, {}});
  time(10);
  EXPECT_TRUE(emergencies().empty());
  time(11);
  const auto frames = emergencies();
  ASSERT_GE(frames.size(), 1U);
  EXPECT_EQ(frames[0].data[0], 0x50);
  EXPECT_EQ(frames[0].data[1], 0x82);
}

TEST_F(Node, ResetCommunicationRestoresCommunicationOnly) {
  EXPECT_EQ(talk_.write(0x1017, 0, 100, 2), 0U);
  EXPECT_EQ(talk_.write(0x6087, 0, 500, 4), 0U);
  nmt(NmtCommand::kResetCommunication, 5);
  EXPECT_EQ(talk_.read(0x1017), 0);
  EXPECT_EQ(talk_.read(0x6087), 500);
  nmt(NmtCommand::kResetNode, 5);
  EXPECT_EQ(talk_.read(0x6087), 100'000);
}

TEST_F(Node, ARemoteFrameGetsThePdoWhereBitThirtyAllowsIt) {
  const CanFrame request{0x185, false, true, 8, {}};
  nmt(NmtCommand::kStart, 5);
  said();
  drive_.onFrame(request);
  EXPECT_TRUE(said().empty()) << "bit 30 is set after power-on";
  EXPECT_EQ(talk_.write(0x1800, 1, 0x80000185, 4), 0U);
  EXPECT_EQ(talk_.write(0x1800, 1, 0x00000185, 4), 0U);
  said();
  drive_.onFrame(request);
  const auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].id, 0x185U);
  EXPECT_EQ(frames[0].size, 8);
  nmt(NmtCommand::kPreOperational, 5);
  said();
  drive_.onFrame(request);
  EXPECT_TRUE(said().empty());
}

TEST_F(Node, RemoteAndExtendedFramesMeanNothingToIt) {
  nmt(NmtCommand::kStart, 5);
  said();
  drive_.onFrame({0x605, true, false, 8, {0x40, 0, 0x10, 0}});
  drive_.onFrame({0x605, false, true, 8, {}});
  drive_.onFrame({0x000, true, false, 2, {2, 5}});
  EXPECT_TRUE(said().empty());
  EXPECT_TRUE(drive_.operational());
}

TEST(CanopenNode, MapsSixtyFourBytesOnCanFdAlone) {
  for (const bool flexible : {false, true}) {
    DriveNode drive({});
    drive.setFlexible(flexible);
    drive.powerOn();
    SdoDialogue talk(drive);
    EXPECT_EQ(talk.write(0x1800, 1, 0xC0000181, 4), 0U);
    EXPECT_EQ(talk.write(0x1A00, 0, 0, 1), 0U);
    const std::int64_t codes[] = {0x60410010, 0x60770010, 0x60640020, 0x606C0020, 0x60E40120};
    std::uint8_t sub = 0;
    for (const std::int64_t code : codes) EXPECT_EQ(talk.write(0x1A00, ++sub, code, 4), 0U);
    EXPECT_EQ(talk.write(0x1A00, 0, sub, 1), flexible ? 0U : 0x06040042U) << "16 bytes";
    if (!flexible) continue;
    EXPECT_EQ(talk.write(0x1A00, 0, 0, 1), 0U);
    EXPECT_EQ(talk.write(0x1A00, 6, 0x60740010, 4), 0U);
    EXPECT_EQ(talk.write(0x1A00, 0, 6, 1), 0U);
    EXPECT_EQ(talk.write(0x1800, 1, 0x40000181, 4), 0U);
    drive.forceNmt(0x01);
    drive.outbox().clear();
    drive.onSync();
    ASSERT_FALSE(drive.outbox().empty());
    const CanFrame frame = drive.outbox().front();
    EXPECT_EQ(frame.size, 20) << "18 bytes, and two that fill it up";
    EXPECT_TRUE(isValid(frame));
    EXPECT_TRUE(frame.flexible && frame.fast);
  }
}

TEST(CanopenNode, SkipsWhatIsAnotherNodesInASharedRpdo) {
  DriveNode drive({});
  drive.setFlexible(true);
  drive.powerOn();
  SdoDialogue talk(drive);
  EXPECT_EQ(talk.write(0x1400, 1, 0x80000202, 4), 0U) << "off, and another identifier";
  EXPECT_EQ(talk.write(0x1600, 0, 0, 1), 0U);
  EXPECT_EQ(talk.write(0x1600, 1, 0x00070020, 4), 0U);
  EXPECT_EQ(talk.write(0x1600, 2, 0x00060010, 4), 0U);
  EXPECT_EQ(talk.write(0x1600, 3, 0x60710010, 4), 0U);
  EXPECT_EQ(talk.write(0x1600, 4, 0x00060020, 4), 0x06040042U) << "type 6 has 16 bits";
  EXPECT_EQ(talk.write(0x1600, 4, 0x00050008, 4), 0U);
  EXPECT_EQ(talk.write(0x1600, 0, 4, 1), 0U);
  EXPECT_EQ(talk.write(0x1400, 1, 0x202, 4), 0U);
  EXPECT_EQ(talk.write(0x1801, 1, 0xC0000281, 4), 0U);
  EXPECT_EQ(talk.write(0x1A01, 0, 0, 1), 0U);
  EXPECT_EQ(talk.write(0x1A01, 1, 0x00070020, 4), 0x06040041U) << "there are none to send";
  drive.forceNmt(0x01);
  CanFrame frame{0x202, false, false, 12, {9, 9, 9, 9, 9, 9, 0x34, 0x12, 9}};
  frame.flexible = frame.fast = true;
  drive.onFrame(frame);
  EXPECT_EQ(drive.dictionary().value(0x6071), 0x1234);
}

TEST(CanopenNode, AnswersSdosLateWhereItIsToldTo) {
  EmulatedDriveParameters p;
  p.sdo_delay_ns = 150'000'000;
  DriveNode drive(p);
  drive.powerOn();
  drive.outbox().clear();
  drive.onTime(10'000'000);
  drive.onFrame({0x601, false, false, 8, {0x40, 0x00, 0x10}});
  EXPECT_TRUE(drive.owesAnswer());
  drive.onTime(159'000'000);
  EXPECT_TRUE(drive.outbox().empty());
  drive.onTime(160'000'000);
  ASSERT_EQ(drive.outbox().size(), 1U);
  EXPECT_EQ(drive.outbox()[0].id, 0x581U);
  EXPECT_FALSE(drive.owesAnswer());
}

}  // namespace
}  // namespace ballbot
