#include "messages/wire.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/step_reply.hpp"
#include "ballbot_msgs/step_request.hpp"
#include "ballbot_msgs/tick_digests.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

ballbot_msgs::step_request exampleRequest() {
  ballbot_msgs::step_request request{};
  request.header = {0, 1, 0x1122334455667788, 42, ballbot_msgs::step_header::STEP};
  request.time_ns = 400'000;
  request.chunk_size = 3;
  request.chunk = {1, 2, 3};
  return request;
}

TEST(Wire, AMessageComesBackAsItWasSent) {
  Bytes bytes;
  encodeMessage(exampleRequest(), bytes);
  ballbot_msgs::step_request back{};
  ASSERT_TRUE(decodeMessage(bytes.data(), bytes.size(), back));
  EXPECT_EQ(back.header.session, 0x1122334455667788);
  EXPECT_EQ(back.header.sequence, 42);
  EXPECT_EQ(back.time_ns, 400'000);
  EXPECT_THAT(back.chunk, testing::ElementsAre(1, 2, 3));
}

TEST(Wire, EveryDamagedBitIsNoticed) {
  Bytes bytes;
  encodeMessage(exampleRequest(), bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes damaged = bytes;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ (1U << bit));
      ASSERT_FALSE(checksumHolds(damaged.data(), damaged.size())) << "byte " << i << " bit " << bit;
    }
  }
}

TEST(Wire, EveryCutMessageIsNoticed) {
  Bytes bytes;
  encodeMessage(exampleRequest(), bytes);
  ballbot_msgs::step_request back{};
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_FALSE(decodeMessage(bytes.data(), size, back)) << size;
  }
}

TEST(Wire, AMessageOfAnotherTypeIsRefused) {
  Bytes bytes;
  encodeMessage(ballbot_msgs::sensor_frame{}, bytes);
  EXPECT_TRUE(checksumHolds(bytes.data(), bytes.size()));
  ballbot_msgs::step_request request{};
  EXPECT_FALSE(decodeMessage(bytes.data(), bytes.size(), request));
}

TEST(Wire, BytesThatSayTheyHoldMoreThanMemoryAreRefused) {
  // A correct checksum around a length that lies.
  Bytes bytes;
  encodeMessage(exampleRequest(), bytes);
  const std::size_t length_at = bytes.size() - 3 - 4;
  for (std::size_t i = 0; i < 4; ++i) bytes[length_at + i] = i == 0 ? 0x80 : 0x00;
  sealMessage(bytes);
  ballbot_msgs::step_request back{};
  EXPECT_FALSE(decodeMessage(bytes.data(), bytes.size(), back));
}

TEST(Wire, AFrameWithACountThatLiesIsRefused) {
  ballbot_msgs::sensor_frame frame{};
  frame.joints = 2;
  for (auto* values :
       {&frame.motor_angle, &frame.joint_angle, &frame.joint_velocity, &frame.joint_torque}) {
    values->assign(2, 1.5);
  }
  Bytes whole;
  encodeMessage(frame, whole);
  ballbot_msgs::sensor_frame back{};
  ASSERT_TRUE(decodeMessage(whole.data(), whole.size(), back));
  EXPECT_THAT(back.joint_torque, testing::ElementsAre(1.5, 1.5));
  constexpr std::size_t kJoints = 8 + 24;  // behind fingerprint, checksum, tick, time
  for (const std::uint32_t lie : {0U, 1U, 3U, 11U, 12U, 1'000'000U, 0x80000000U, 0xFFFFFFFFU}) {
    Bytes bytes = whole;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[kJoints + i] = static_cast<std::uint8_t>(lie >> (24 - 8 * i));
    }
    sealMessage(bytes);
    EXPECT_FALSE(decodeMessage(bytes.data(), bytes.size(), back)) << lie;
  }
}

/// A full reply, and where its three lengths stand.
struct LongReply {
  LongReply() {
    reply.text = "text";
    reply.truth_count = 1;
    reply.truth.resize(1);
    reply.chunk_size = 5;
    reply.chunk.resize(5, 7);
    encodeMessage(reply, bytes);
  }
  static constexpr std::size_t kText = 8 + 29 + 10;  // behind the header, server, status, exit code
  static constexpr std::size_t kTruth = kText + 4 + 5 + 16 + 132;  // text, times, empty sensors
  std::size_t chunk() const { return bytes.size() - 5 - 4; }

  /// The same with another 4-byte number at `at` and a good checksum.
  Bytes with(std::size_t at, std::uint32_t number) const {
    Bytes out = bytes;
    for (std::size_t i = 0; i < 4; ++i) {
      out[at + i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
    }
    sealMessage(out);
    return out;
  }
  ballbot_msgs::step_reply reply{};
  Bytes bytes;
};

TEST(Wire, ALengthThatLiesIsRefusedBeforeAnythingIsDecoded) {
  const LongReply whole;
  ballbot_msgs::step_reply back{};
  const auto taken = [&](std::size_t at, std::uint32_t number) {
    const Bytes bytes = whole.with(at, number);
    return decodeMessage(bytes.data(), bytes.size(), back);
  };
  ASSERT_TRUE(taken(LongReply::kText, 5));
  ASSERT_TRUE(taken(LongReply::kTruth, 1));
  ASSERT_TRUE(taken(whole.chunk(), 5));
  for (const std::uint32_t lie : {0U, 3U, 6U, 300U, 2'000'000U, 0x7FFFFFFFU, 0x80000000U,
                                  0x80000001U, 0xFFFFFFFEU, 0xFFFFFFFFU}) {
    EXPECT_FALSE(taken(LongReply::kText, lie)) << lie;
    EXPECT_FALSE(taken(LongReply::kTruth, lie)) << lie;
    EXPECT_FALSE(taken(whole.chunk(), lie)) << lie;
  }
  EXPECT_LE(back.truth.capacity(), 1U) << "nothing was made room for";
}

TEST(Wire, ATextWithoutItsZeroIsRefused) {
  const LongReply whole;
  Bytes bytes = whole.bytes;
  bytes[LongReply::kText + 4 + 4] = 'x';
  sealMessage(bytes);
  ballbot_msgs::step_reply back{};
  EXPECT_FALSE(decodeMessage(bytes.data(), bytes.size(), back));
}

TEST(Wire, TickDigestsWithCountsThatLieAreRefused) {
  ballbot_msgs::tick_digests digests{};
  digests.tick_count = 2;
  digests.offset_ns = {0, 1};
  digests.hash_count = 12;
  digests.hash.resize(12);
  Bytes bytes;
  encodeMessage(digests, bytes);
  ballbot_msgs::tick_digests back{};
  ASSERT_TRUE(decodeMessage(bytes.data(), bytes.size(), back));
  const std::size_t counts[] = {8 + 24, 8 + 24 + 4 + 8};
  for (const std::size_t at : counts) {
    for (const int high : {0x7F, 0x80, 0xFF}) {
      Bytes lie = bytes;
      lie[at] = static_cast<std::uint8_t>(high);
      sealMessage(lie);
      EXPECT_FALSE(decodeMessage(lie.data(), lie.size(), back));
    }
  }
}

TEST(Wire, TheHeaderIsReadableInRequestsAndRepliesOfAnyVersion) {
  Bytes bytes;
  encodeMessage(exampleRequest(), bytes);
  bytes[0] = static_cast<std::uint8_t>(bytes[0] ^ 0xFF);  // the fingerprint of other definitions
  bytes.push_back(0);                                     // and another length
  sealMessage(bytes);
  ballbot_msgs::step_header header{};
  ASSERT_TRUE(decodeHeader(bytes.data(), bytes.size(), header));
  EXPECT_EQ(header.session, 0x1122334455667788);
  EXPECT_EQ(header.sequence, 42);
  EXPECT_EQ(header.kind, ballbot_msgs::step_header::STEP);

  ballbot_msgs::step_reply reply{};
  reply.header = header;
  encodeMessage(reply, bytes);
  ASSERT_TRUE(decodeHeader(bytes.data(), bytes.size(), header));
  EXPECT_EQ(header.sequence, 42);
}

TEST(Wire, AMessageThatWouldBeFragmentedIsNotSent) {
  ballbot_msgs::step_request request = exampleRequest();
  request.chunk.resize(kMaxMessageBytes);
  request.chunk_size = static_cast<std::int32_t>(request.chunk.size());
  Bytes bytes;
  try {
    encodeMessage(request, bytes);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("is too long, at most 1400 fit"));
  }
}

TEST(Wire, TheFullestReplyFitsOnePacket) {
  ballbot_msgs::step_reply reply{};
  reply.text.assign(400, 'x');
  reply.truth_count = 1;
  reply.truth.resize(1);
  Bytes bytes;
  encodeMessage(reply, bytes);
  EXPECT_LT(bytes.size(), kMaxMessageBytes);

  reply.text.clear();
  reply.truth_count = 0;
  reply.truth.clear();
  reply.chunk_size = 700;
  reply.chunk.resize(700);
  encodeMessage(reply, bytes);
  EXPECT_LT(bytes.size(), kMaxMessageBytes);
}

}  // namespace
}  // namespace ballbot
