// The master's SDO client and the emulated nodes' SDO server, written apart, against each other and
// against byte strings from CiA 301.
#include <gtest/gtest.h>

#include "hil/emulator/drive_node.hpp"
#include "tests/hil/support/sdo_dialogue.hpp"

namespace ballbot {
namespace {

class Sdo : public ::testing::Test {
 protected:
  Sdo() : drive_({}), talk_(drive_) {
    drive_.powerOn();
    drive_.outbox().clear();
  }
  std::vector<std::uint8_t> answer(std::array<std::uint8_t, 8> request) {
    CanFrame f{0x601, false, false, 8, {}};
    std::copy(request.begin(), request.end(), f.data.begin());
    drive_.outbox().clear();
    drive_.onFrame(f);
    if (drive_.outbox().empty()) return {};
    const CanFrame a = drive_.outbox().front();
    drive_.outbox().clear();
    EXPECT_EQ(a.id, 0x581U);
    EXPECT_EQ(a.size, 8);
    return {a.data.begin(), a.data.begin() + a.size};
  }
  DriveNode drive_;
  SdoDialogue talk_;
};
using Bytes = std::vector<std::uint8_t>;

TEST_F(Sdo, TheServerAnswersTheByteStringsOfTheStandard) {
  EXPECT_EQ(answer({0x40, 0x00, 0x10, 0, 0, 0, 0, 0}),
            (Bytes{0x43, 0, 0x10, 0, 0x92, 0x01, 0x02, 0}));
  EXPECT_EQ(answer({0x40, 0x01, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x4F, 1, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x2B, 0x17, 0x10, 0, 0x64, 0, 0, 0}), (Bytes{0x60, 0x17, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x40, 0x17, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x4B, 0x17, 0x10, 0, 0x64, 0, 0, 0}));
  EXPECT_EQ(answer({0x40, 0x99, 0x29, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x99, 0x29, 0, 0, 0, 2, 6}));
  EXPECT_EQ(answer({0xA0, 0x08, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x80, 8, 0x10, 0, 1, 0, 4, 5}))
      << "block transfer";
  EXPECT_EQ(answer({0x80, 0x08, 0x10, 0, 0, 0, 4, 5}), Bytes{}) << "an abort is not answered";
  EXPECT_EQ(answer({0x22, 0x17, 0x10, 0, 0x32, 0, 0, 0})[0], 0x60) << "expedited without a size";
  EXPECT_EQ(answer({0x60, 0, 0, 0, 0, 0, 0, 0})[0], 0x80) << "a segment out of the blue";
}

TEST_F(Sdo, SegmentsCarryANameAndTheToggleBit) {
  EXPECT_EQ(talk_.readText(0x1008), "ballbot emulated drive");
  EXPECT_EQ(answer({0x40, 0x08, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x41, 8, 0x10, 0, 22, 0, 0, 0}));
  EXPECT_EQ(answer({0x60, 0, 0, 0, 0, 0, 0, 0}), (Bytes{0x00, 'b', 'a', 'l', 'l', 'b', 'o', 't'}));
  EXPECT_EQ(answer({0x60, 0, 0, 0, 0, 0, 0, 0}), (Bytes{0x80, 8, 0x10, 0, 0, 0, 3, 5})) << "toggle";
}

TEST_F(Sdo, ASegmentedDownloadIsStoredWhole) {
  EXPECT_EQ(answer({0x21, 0x17, 0x10, 0, 2, 0, 0, 0}), (Bytes{0x60, 0x17, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x0B, 0xE8, 0x03, 0, 0, 0, 0, 0}), (Bytes{0x20, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(talk_.read(0x1017), 1000);
  EXPECT_EQ(talk_.write(0x6064, 0, 1, 4), 0x06010002U);
  const std::uint32_t code = talk_.write(0x1017, 0, 1, 8);
  EXPECT_EQ(code, 0x06070010U) << "eight bytes into two";
}

TEST_F(Sdo, EveryRefusalHasItsCode) {
  EXPECT_EQ(talk_.write(0x1000, 0, 1, 4), 0x06010002U);
  EXPECT_FALSE(talk_.read(0x1018, 9));
  EXPECT_EQ(talk_.abortCode(), 0x06090011U);
  EXPECT_EQ(talk_.write(0x6060, 0, 3, 1), 0x06090030U) << "profile velocity is not supported";
  EXPECT_EQ(talk_.write(0x6060, 0, 10, 2), 0x06070010U);
  EXPECT_EQ(talk_.write(0x1029, 1, 3, 1), 0x06090031U);
  EXPECT_EQ(talk_.write(0x60C2, 1, 0, 1), 0x06090032U);
  EXPECT_EQ(talk_.write(0x60C2, 2, -7, 1), 0x06090032U) << "signed comparison";
  EXPECT_EQ(talk_.write(0x1016, 1, 0x00010064, 4), 0U);
  EXPECT_EQ(talk_.write(0x1016, 2, 0x00010032, 4), 0x06040043U) << "the same producer twice";
  EXPECT_EQ(talk_.write(0x1003, 0, 1, 1), 0x06090030U);
}

TEST_F(Sdo, TheClientGivesUpOnSilenceAndSaysSo) {
  drive_.muteSdo(true);
  EXPECT_FALSE(talk_.read(0x1000));
  EXPECT_EQ(talk_.client().status(), SdoClient::Status::kTimedOut);
  EXPECT_EQ(talk_.abortCode(), 0x05040000U);
  EXPECT_STREQ(sdoAbortText(talk_.abortCode()), "SDO protocol timed out");
}

TEST_F(Sdo, TheClientRefusesAServerThatDoesNotToggle) {
  SdoClient client(1, 10);
  FrameQueue out;
  client.upload({0x1008, 0}, out);
  client.onFrame({0x581, false, false, 8, {0x41, 8, 0x10, 0, 22}}, out);
  client.onFrame({0x581, false, false, 8, {0x00, 'b'}}, out);
  client.onFrame({0x581, false, false, 8, {0x00, 'a'}}, out);
  EXPECT_EQ(client.status(), SdoClient::Status::kAborted);
  EXPECT_EQ(client.abortCode(), 0x05030000U);
  const CanFrame last = *(out.end() - 1);
  EXPECT_EQ(last, (CanFrame{0x601, false, false, 8, {0x80, 8, 0x10, 0, 0, 0, 3, 5}}));
}

// As some adapters show every frame twice.
TEST_F(Sdo, TheClientTakesADoubledAnswerOnce) {
  SdoClient client(1, 10);
  FrameQueue queue;
  const auto run = [&] {
    while (client.status() == SdoClient::Status::kBusy && queue.size() > 0) {
      const FrameQueue sent = queue;
      queue.clear();
      for (const CanFrame& frame : sent) drive_.onFrame(frame);
      for (const CanFrame& frame : drive_.outbox()) {
        client.onFrame(frame, queue);
        client.onFrame(frame, queue);
      }
      drive_.outbox().clear();
    }
  };
  client.upload({0x1008, 0}, queue);
  run();
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(client.data()), client.size()),
            "ballbot emulated drive");
  // The second copy of an acknowledgement comes when the value is read back already.
  const std::uint8_t period[2] = {100, 0};
  client.download({0x1017, 0}, period, 2, queue);
  drive_.onFrame(*queue.begin());
  queue.clear();
  const CanFrame acknowledgement = drive_.outbox().front();
  drive_.outbox().clear();
  client.onFrame(acknowledgement, queue);
  client.upload({0x1017, 0}, queue);
  client.onFrame(acknowledgement, queue);
  EXPECT_EQ(client.status(), SdoClient::Status::kBusy) << "not aborted";
  run();
  EXPECT_EQ(client.status(), SdoClient::Status::kDone);
  EXPECT_EQ(client.data()[0], 100);
}

TEST_F(Sdo, TheClientIgnoresAnswersToOtherQuestions) {
  SdoClient client(1, 10);
  FrameQueue out;
  client.upload({0x1000, 0}, out);
  client.onFrame({0x581, false, false, 8, {0x43, 0x01, 0x10, 0, 1, 2, 3, 4}}, out);
  EXPECT_EQ(client.status(), SdoClient::Status::kBusy);
  EXPECT_FALSE(client.onFrame({0x582, false, false, 8, {0x43, 0, 0x10, 0}}, out));
  EXPECT_FALSE(client.onFrame({0x581, false, false, 7, {0x43, 0, 0x10, 0}}, out));
  client.onFrame({0x581, false, false, 8, {0x43, 0x00, 0x10, 0, 0x92, 1, 2, 0}}, out);
  EXPECT_EQ(client.status(), SdoClient::Status::kDone);
  EXPECT_EQ(getLittleEndian(client.data(), 4), 0x00020192U);
}

}  // namespace
}  // namespace ballbot
