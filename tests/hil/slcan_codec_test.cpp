#include "hil/slcan_codec.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

using Item = SlcanParser::Item;

std::string encoded(const CanFrame& frame) {
  std::array<char, kSlcanLineMax> line;
  return {line.data(), encodeSlcan(frame, line)};
}

std::vector<Item> parsed(const std::string& text, SlcanParser& parser) {
  std::vector<Item> items;
  for (const char c : text) {
    const Item item = parser.take(c);
    if (item != Item::kNone) items.push_back(item);
  }
  return items;
}
std::vector<Item> parsed(const std::string& text) {
  SlcanParser parser;
  return parsed(text, parser);
}

TEST(SlcanCodec, WritesTheLinesOfTheManual) {
  EXPECT_EQ(encoded({0x10, false, false, 0, {}}), "t0100\r");
  EXPECT_EQ(encoded({0x100, false, false, 2, {0x11, 0x33}}), "t10021133\r");
  EXPECT_EQ(encoded({0x100, true, false, 1, {0xAB}}), "T000001001AB\r");
  EXPECT_EQ(encoded({0x123, false, true, 4, {1, 2, 3, 4}}), "r1234\r");
  EXPECT_EQ(encoded({0x123, true, true, 0, {}}), "R000001230\r");
  EXPECT_EQ(encoded({0x800, false, false, 0, {}}), "") << "12 bits are no identifier";
}

TEST(SlcanCodec, WritesCanFdAsCanableAdaptersDo) {
  CanFrame frame{0x181, false, false, 12, {0xAB}};
  frame.flexible = true;
  EXPECT_EQ(encoded(frame), "d1819AB" + std::string(22, '0') + "\r");
  frame.fast = frame.extended = true;
  frame.size = 64;
  EXPECT_EQ(encoded(frame), "B00000181FAB" + std::string(126, '0') + "\r");
  SlcanParser parser;
  EXPECT_EQ(parsed(encoded(frame), parser), std::vector<Item>{Item::kFrame});
  EXPECT_EQ(parser.frame(), frame);
  frame.size = 9;
  EXPECT_EQ(encoded(frame), "");
}

TEST(SlcanCodec, ReadsFramesRepliesAndFlags) {
  SlcanParser parser;
  EXPECT_EQ(parsed("\r\az\rZ\rt10021133\rV1013\rNA123\rF24\r", parser),
            (std::vector<Item>{Item::kDone, Item::kRefused, Item::kDone, Item::kDone, Item::kFrame,
                               Item::kText, Item::kText, Item::kStatus}));
  EXPECT_EQ(parser.frame(), (CanFrame{0x100, false, false, 2, {0x11, 0x33}}));
  EXPECT_EQ(parser.status(), 0x24);
}

TEST(SlcanCodec, ToleratesTimeStampsAndSmallLetters) {
  SlcanParser parser;
  EXPECT_EQ(parsed("t1fF2aBcDEA5F\r", parser), std::vector<Item>{Item::kFrame});
  EXPECT_EQ(parser.frame(), (CanFrame{0x1FF, false, false, 2, {0xAB, 0xCD}}));
  EXPECT_EQ(parsed("r1FF8EA5F\r", parser), std::vector<Item>{Item::kFrame});
  EXPECT_TRUE(parser.frame().remote);
}

TEST(SlcanCodec, ToleratesLineFeedsAndLongTimeStamps) {
  SlcanParser parser;
  EXPECT_EQ(parsed("\r\nz\r\nt10021133\r\n", parser),
            (std::vector<Item>{Item::kDone, Item::kDone, Item::kFrame}));
  EXPECT_EQ(parsed("t10021133DEADBEEF\r", parser), std::vector<Item>{Item::kFrame});
  EXPECT_EQ(parser.frame(), (CanFrame{0x100, false, false, 2, {0x11, 0x33}}));
  EXPECT_EQ(parsed("T1ABCDEF0801020304050607080123ABCD\r", parser),
            std::vector<Item>{Item::kFrame});
  EXPECT_EQ(parsed("t10\n0\r", parser), std::vector<Item>{Item::kMalformed}) << "within a line";
}

TEST(SlcanCodec, RefusesWhateverIsNotExactlyALine) {
  for (const char* line : {"t",         "t1",         "t12",          "t123",  "t1239", "t12312",
                           "t1231ABC",  "t1231ABCDE", "t1231ABCDEF0", "t8000", "tG000", "t1231XY",
                           "T20000000", "T200000000", "t123-1",       "x",     "F1",    "F1G",
                           "V123",      "zz",         "t0FF 1",       "r1231A"}) {
    EXPECT_EQ(parsed(std::string(line) + "\r"), std::vector<Item>{Item::kMalformed}) << line;
  }
}

TEST(SlcanCodec, FindsTheNextLineAfterRubbish) {
  SlcanParser parser;
  const std::string rubbish(500, 't');
  EXPECT_EQ(parsed(rubbish + "\rt1000\r", parser),
            (std::vector<Item>{Item::kMalformed, Item::kFrame}));
  EXPECT_EQ(parsed("t12\at1000\r", parser), (std::vector<Item>{Item::kRefused, Item::kFrame}));
}

}  // namespace
}  // namespace ballbot
