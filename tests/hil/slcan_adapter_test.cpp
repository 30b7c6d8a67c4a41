#include "hil/emulator/slcan_adapter.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

struct Desk {
  SlcanAdapter adapter;
  CanFrame sent;
  int frames = 0;

  std::string say(const std::string& text) {
    std::string reply;
    for (const char c : text) frames += adapter.take(c, reply, sent) ? 1 : 0;
    return reply;
  }
};

TEST(SlcanAdapter, FollowsTheOrderRateOpenSendClose) {
  Desk d;
  EXPECT_EQ(d.say("t1000\r"), "\a") << "the channel is closed";
  EXPECT_EQ(d.say("C\rS8\rO\r"), "\r\r\r");
  EXPECT_EQ(d.say("S8\r"), "\a") << "the rate of an open channel is fixed";
  EXPECT_EQ(d.say("O\r"), "\r") << "hosts open twice";
  EXPECT_EQ(d.say("t10021133\r"), "z\r");
  EXPECT_EQ(d.sent, (CanFrame{0x100, false, false, 2, {0x11, 0x33}}));
  EXPECT_EQ(d.say("T1ABCDEF00\r"), "Z\r");
  EXPECT_EQ(d.say("R000001238\r"), "Z\r");
  EXPECT_TRUE(d.sent.remote && d.sent.extended);
  EXPECT_EQ(d.frames, 3);
  EXPECT_EQ(d.say("C\rt1000\r"), "\r\a");
}

TEST(SlcanAdapter, AnswersVersionSerialNumberAndFlags) {
  Desk d;
  EXPECT_EQ(d.say("V\r"), "V1013\r");
  EXPECT_EQ(d.say("N\r"), "NBALL\r");
  EXPECT_EQ(d.say("F\r"), "\a");
  EXPECT_EQ(d.say("O\r"), "\r");
  d.adapter.setStatus(0x80);
  EXPECT_EQ(d.say("F\rF\r"), "F80\rF00\r") << "reading clears";
}

TEST(SlcanAdapter, ListenOnlyDoesNotSend) {
  Desk d;
  EXPECT_EQ(d.say("L\rt1000\r"), "\r\a");
  EXPECT_EQ(d.frames, 0);
}

TEST(SlcanAdapter, RefusesWrongLinesWithBell) {
  Desk d;
  d.say("O\r");
  for (const char* line :
       {"t", "t10", "t1009", "t10011", "t1001112", "t8001AA", "T200000000", "y", "t1001GG",
        "r10011", "S", "O1", "tttttttttttttttttttttttttttttttttttt"}) {
    EXPECT_EQ(d.say(std::string(line) + "\r"), "\a") << line;
  }
  EXPECT_EQ(d.frames, 0);
}

TEST(SlcanAdapter, ShowsFramesWithTimeStampWhenAsked) {
  Desk d;
  std::string out;
  d.adapter.show({0x100, false, false, 1, {0xAB}}, 0, out);
  EXPECT_EQ(out, "") << "closed";
  d.say("Z1\rO\r");
  d.adapter.show({0x100, false, false, 1, {0xAB}}, 60'255, out);
  d.adapter.show({0x1ABCDEF, true, true, 3, {}}, 1, out);
  EXPECT_EQ(out, "t1001AB00FF\rR01ABCDEF30001\r");
}

}  // namespace
}  // namespace ballbot
