#include "cosim/lcm_packet.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/cosim/support/stranger.hpp"

namespace ballbot {
namespace {

using testing_support::fragment;

Bytes bytesOf(const std::string& text) { return Bytes(text.begin(), text.end()); }

bool taken(const std::string& packet) {
  const Bytes bytes = bytesOf(packet);
  return parseLcmPacket(bytes.data(), bytes.size()).has_value();
}

const std::string kStart = std::string("LC02") + std::string("\0\0\0\1", 4);

TEST(LcmPacket, LiesInAPacketAsLcmWritesIt) {
  const Bytes message{1, 2, 3};
  Bytes packet;
  ASSERT_TRUE(buildLcmPacket("A_b-1", message.data(), message.size(), 0x01020304, packet));
  EXPECT_EQ(packet, bytesOf(std::string("LC02\1\2\3\4A_b-1\0\1\2\3", 17)));
  const auto back = parseLcmPacket(packet.data(), packet.size());
  ASSERT_TRUE(back);
  EXPECT_EQ(back->channel, "A_b-1");
  EXPECT_EQ(Bytes(back->data, back->data + back->size), message);
}

TEST(LcmPacket, IsNotTakenWhenCutOrWithoutEnd) {
  const std::string whole = kStart + std::string("CHANNEL\0", 8);
  EXPECT_TRUE(taken(whole));  // an empty message is one
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(taken(whole.substr(0, size))) << size;
  }
}

TEST(LcmPacket, IsNotTakenWithANameThatIsNone) {
  const std::string zero(1, '\0');
  EXPECT_FALSE(taken(kStart + zero + "data"));
  EXPECT_FALSE(taken(kStart + "A.*" + zero));
  EXPECT_FALSE(taken(kStart + "A\x1B[2J" + zero));
  EXPECT_TRUE(taken(kStart + std::string(63, 'A') + zero));
  EXPECT_FALSE(taken(kStart + std::string(64, 'A') + zero));
}

TEST(LcmPacket, IsNotTakenWithAMessageLongerThanAnyOfOurs) {
  const std::string begin = kStart + "A" + std::string(1, '\0');
  EXPECT_TRUE(taken(begin + std::string(kMaxMessageBytes, 'x')));
  EXPECT_FALSE(taken(begin + std::string(kMaxMessageBytes + 1, 'x')));
  const Bytes long_message(kMaxMessageBytes + 1);
  Bytes packet;
  EXPECT_FALSE(buildLcmPacket("A", long_message.data(), long_message.size(), 0, packet));
}

TEST(LcmPacket, OfALongMessageIsNeverTaken) {
  // Offset and size together go beyond 32 bits; no parts at all; a part beyond the last.
  for (const Bytes& packet :
       {fragment(100, 0xFFFFFFF0, 1, 2, "A"), fragment(0xFFFFFFFF, 0, 0, 1, "A"),
        fragment(100, 0, 0, 0, "A"), fragment(100, 50, 9, 2, "A")}) {
    ASSERT_EQ(packet.size(), 80U);
    EXPECT_FALSE(parseLcmPacket(packet.data(), packet.size()));
  }
}

}  // namespace
}  // namespace ballbot
