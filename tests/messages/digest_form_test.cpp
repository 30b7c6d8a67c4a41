#include "messages/digest_form.hpp"

#include <gtest/gtest.h>

#include "ballbot_msgs/plan_report.hpp"
#include "messages/convert.hpp"

namespace ballbot {
namespace {

std::uint64_t tagOf(const Bytes& bytes) {
  std::uint64_t tag = 0;
  for (std::size_t i = 0; i < 8; ++i) tag = tag << 8 | bytes[i];
  return tag;
}

template <typename Message, typename Frame>
Message messageOf(const Frame& frame) {
  Message message{};
  toMessage(frame, 7, message);
  return message;
}

// What every digest that was ever published stands on: numbers in LCM's order behind the
// fingerprints of the first definitions, which had lists of fixed length.
TEST(DigestForm, IsTheMessageWithoutItsCountsUnderTheFirstFingerprint) {
  TruthFrame frame;
  frame.state[kBallX] = 0.25;
  Bytes bytes, room;
  encodeMessage(messageOf<ballbot_msgs::truth_frame>(frame), bytes);
  const Bytes form = digestForm<ballbot_msgs::truth_frame>(bytes, room);
  ASSERT_EQ(form.size(), bytes.size() - 8);  // joints and coordinates
  EXPECT_EQ(tagOf(form), 0xb5c7270c08d5aaa2);
  EXPECT_TRUE(checksumHolds(form.data(), form.size()));
  EXPECT_EQ(Bytes(form.begin() + 16, form.begin() + 32),
            Bytes(bytes.begin() + 16, bytes.begin() + 32));
  EXPECT_EQ(Bytes(form.begin() + 32, form.end()), Bytes(bytes.begin() + 40, bytes.end()));

  encodeMessage(messageOf<ballbot_msgs::sensor_frame>(SensorFrame()), bytes);
  EXPECT_EQ(tagOf(digestForm<ballbot_msgs::sensor_frame>(bytes, room)), 0x34b8ff0b95c45e24);
  encodeMessage(messageOf<ballbot_msgs::state_estimate>(EstimateFrame()), bytes);
  EXPECT_EQ(tagOf(digestForm<ballbot_msgs::state_estimate>(bytes, room)), 0x749064bc52ea3cb9);
  ballbot_msgs::actuator_command command{};
  toMessage(ActuatorCommand(), 7, kSimStart, command);
  encodeMessage(command, bytes);
  EXPECT_EQ(tagOf(digestForm<ballbot_msgs::actuator_command>(bytes, room)), 0x5c0959b963d1976a);
}

TEST(DigestForm, OfAMessageWithoutCountsIsTheMessage) {
  Bytes bytes, room;
  encodeMessage(messageOf<ballbot_msgs::plan_report>(PlanFrame()), bytes);
  EXPECT_EQ(&digestForm<ballbot_msgs::plan_report>(bytes, room), &bytes);
}

}  // namespace
}  // namespace ballbot
