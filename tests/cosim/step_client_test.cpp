#include "cosim/step_client.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

using Received = StepClient::Received;

class StepClientTest : public testing::Test {
 protected:
  Bytes replyTo(std::int64_t session, std::int64_t sequence, std::int64_t server = 5) {
    ballbot_msgs::step_reply reply{};
    reply.header = {0, kProtocolVersion, session, sequence, ballbot_msgs::step_header::HELLO};
    reply.server = server;
    reply.time_ns = 1000 * sequence;
    Bytes bytes;
    encodeMessage(reply, bytes);
    return bytes;
  }
  Received hear(const Bytes& bytes) { return client.receive(bytes.data(), bytes.size()); }

  StepClient client{77, 1};
};

TEST_F(StepClientTest, TakesOnlyTheExpectedReplyAndOnlyOnce) {
  client.hello(kSimStart);
  EXPECT_EQ(hear(replyTo(77, 1)), Received::kReply);
  EXPECT_EQ(client.reply().time_ns, 1000);
  EXPECT_EQ(hear(replyTo(77, 1)), Received::kIgnored);
  client.reset(kSimStart);
  EXPECT_EQ(hear(replyTo(77, 1)), Received::kIgnored);
  EXPECT_EQ(client.reply().time_ns, 1000);
  EXPECT_EQ(hear(replyTo(77, 2)), Received::kReply);
  EXPECT_EQ(client.reply().time_ns, 2000);
  EXPECT_EQ(client.ignored().old, 2);
}

TEST_F(StepClientTest, IgnoresAndCountsForeignAndDamagedReplies) {
  client.hello(kSimStart);
  EXPECT_EQ(hear(replyTo(78, 1)), Received::kIgnored);
  Bytes damaged = replyTo(77, 1);
  damaged[100] ^= 1;
  EXPECT_EQ(hear(damaged), Received::kIgnored);
  EXPECT_EQ(client.ignored().foreign, 1);
  EXPECT_EQ(client.ignored().damaged, 1);
  EXPECT_EQ(client.ignored().total(), 2);
}

TEST_F(StepClientTest, ARequestStaysTheSameUntilItsReplyIsThere) {
  const Bytes first = client.hello(kSimStart);
  hear(replyTo(78, 1));
  EXPECT_EQ(client.pending(), first);
}

TEST_F(StepClientTest, NoticesASecondProcessThatAnswers) {
  client.hello(kSimStart);
  EXPECT_EQ(hear(replyTo(77, 1, 5)), Received::kReply);
  EXPECT_EQ(hear(replyTo(77, 1, 6)), Received::kSecondServer);
}

TEST_F(StepClientTest, NoticesAnAnswerInOtherMessageDefinitions) {
  client.hello(kSimStart);
  Bytes reply = replyTo(77, 1);
  reply[3] ^= 0x10;
  sealMessage(reply);
  EXPECT_EQ(hear(reply), Received::kOtherVersion);
}

}  // namespace
}  // namespace ballbot
