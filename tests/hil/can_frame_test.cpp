#include "hil/can_frame.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

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
  EXPECT_EQ(full.nominal, 111);
  EXPECT_EQ(full.worst, 135);
  const FrameBits empty = bitsOf({0x80, false, false, 0, {}});
  EXPECT_EQ(empty.nominal, 47);
  EXPECT_EQ(empty.worst, 55);
  EXPECT_EQ(bitsOf({1, true, false, 8, {}}).nominal, 131);
}

}  // namespace
}  // namespace ballbot
