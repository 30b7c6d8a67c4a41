#include "hil/can_frame.hpp"

#include <gtest/gtest.h>

#include "hil/frame_bits.hpp"
#include "tests/hil/support/bit_stream.hpp"
#include "tests/hil/support/random_bytes.hpp"

namespace ballbot {
namespace {

CanFrame flexible(std::uint32_t id, std::uint8_t size) {
  CanFrame frame{id, false, false, size, {}};
  frame.flexible = frame.fast = true;
  return frame;
}

TEST(CanFrame, IsValidOnlyWithinItsIdentifierAndSize) {
  EXPECT_TRUE(isValid({0x7FF, false, false, 8, {}}));
  EXPECT_FALSE(isValid({0x800, false, false, 0, {}}));
  EXPECT_TRUE(isValid({0x1FFFFFFF, true, false, 0, {}}));
  EXPECT_FALSE(isValid({0x20000000, true, false, 0, {}}));
  EXPECT_FALSE(isValid({0, false, false, 9, {}}));
}

TEST(CanFrame, EqualityIgnoresWhatIsNotSent) {
  const CanFrame a{1, false, false, 1, {7, 1}}, b{1, false, false, 1, {7, 2}};
  EXPECT_EQ(a, b);
  EXPECT_NE(a, (CanFrame{1, false, false, 2, {7, 1}}));
  EXPECT_EQ((CanFrame{1, false, true, 1, {7}}), (CanFrame{1, false, true, 1, {8}}));
}

// ISO 11898-1: 44 + 8 n bits and 3 of interframe space; at most one stuff bit per four bits.
TEST(CanFrame, BitsAreThoseOfTheStandard) {
  const FrameBits full = bitsOf({0x181, false, false, 8, {}});
  EXPECT_EQ(full.nominal.slow, 111);
  EXPECT_EQ(full.worst.slow, 135);
  EXPECT_EQ(full.worst.fast, 0);
  const FrameBits empty = bitsOf({0x80, false, false, 0, {}});
  EXPECT_EQ(empty.nominal.slow, 47);
  EXPECT_EQ(empty.worst.slow, 55);
  EXPECT_EQ(bitsOf({1, true, false, 8, {}}).nominal.slow, 131);
}

TEST(CanFrame, OfCanFdIsValidOnlyWithALengthThatThereIs) {
  EXPECT_TRUE(isValid(flexible(0x181, 64)));
  EXPECT_TRUE(isValid(flexible(0x181, 0)));
  EXPECT_FALSE(isValid(flexible(0x181, 9)));
  EXPECT_FALSE(isValid(flexible(0x181, 65)));
  CanFrame frame = flexible(0x181, 8);
  frame.remote = true;
  EXPECT_FALSE(isValid(frame)) << "CAN FD has no remote frames";
  frame = {0x181, false, false, 8, {}};
  frame.fast = true;
  EXPECT_FALSE(isValid(frame)) << "a classic frame has one rate";
  EXPECT_EQ(flexibleLengthCode(18), 11);
  EXPECT_EQ(kFlexibleSizes[11], 20);
  EXPECT_NE(flexible(1, 8), (CanFrame{1, false, false, 8, {}}));
}

// Against an encoder that makes the very bits of a frame, written apart (support/bit_stream.hpp).
TEST(CanFrame, BitsAreThoseOfAnEncoder) {
  RandomBytes random(21);
  for (int i = 0; i < 4000; ++i) {
    CanFrame frame = random.frame();
    if (i % 2 == 0) {
      frame = flexible(frame.id, kFlexibleSizes[random.below(16)]);
      frame.extended = frame.id > CanFrame::kMaxStandardId;
      frame.fast = i % 8 != 0;
      for (int b = 0; b < frame.size; ++b) {
        const bool runs = i % 4 == 0;  // of equal bits, which are stuffed most
        frame.data[static_cast<std::size_t>(b)] =
            runs ? static_cast<std::uint8_t>(b % 2 == 0 ? 0x83 : 0xE0) : random.byte();
      }
    }
    const FrameBits bits = bitsOf(frame);
    const BitStream bare = encodeBits(frame, false), sent = encodeBits(frame, true);
    ASSERT_EQ(bits.nominal.slow, bare.slow) << i;
    ASSERT_EQ(bits.nominal.fast, bare.fast) << i;
    ASSERT_LE(sent.slow + sent.fast, bits.worst.slow + bits.worst.fast) << i;
    ASSERT_LE(sent.slow, bits.worst.slow) << i;
    ASSERT_LE(bits.worst.microseconds(1000, 5000), 1.35 * sent.microseconds(1000, 5000)) << i;
  }
}

// The most stuff bits that any identifier and any data can have, found by trying: the bound is not
// missed by more than the few bits that no frame is free to choose.
TEST(CanFrame, TheBoundOfStuffingIsNearlyReached) {
  for (const std::uint8_t size :
       {std::uint8_t{0}, std::uint8_t{8}, std::uint8_t{20}, std::uint8_t{64}}) {
    for (const bool fd : {false, true}) {
      if (!fd && size > 8) continue;
      CanFrame frame = fd ? flexible(0, size) : CanFrame{0, false, false, size, {}};
      const int most = mostStuffBits(frame);
      const FrameBits bits = bitsOf(frame);
      const auto bound = static_cast<int>(bits.worst.slow + bits.worst.fast - bits.nominal.slow -
                                          bits.nominal.fast);
      EXPECT_LE(most, bound) << int{size} << (fd ? " FD" : "");
      EXPECT_GE(most, bound - 3) << int{size} << (fd ? " FD" : "");
    }
  }
}

}  // namespace
}  // namespace ballbot
