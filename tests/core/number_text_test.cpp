#include "core/number_text.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(NumberText, ReadsDecimalOnly) {
  EXPECT_EQ(parseNumber("012"), 12);
  EXPECT_EQ(parseNumber("+0.6"), 0.6);
  EXPECT_EQ(parseNumber("-.5"), -0.5);
  EXPECT_EQ(parseNumber("1e-3"), 1e-3);
  for (const char* none :
       {"", "+", "-", "+-0.6", "-+0.6", "--1", "0x10", "1,5", "1 ", " 1", "1s", "1e400"}) {
    EXPECT_FALSE(parseNumber(none)) << "'" << none << "'";
  }
  EXPECT_TRUE(std::isnan(parseNumber("nan").value_or(0)))
      << "the caller has words of its own for it";
}

TEST(NumberText, WholeNumbersAreThoseThatADoubleHolds) {
  EXPECT_EQ(parseWhole("012"), 12);
  EXPECT_EQ(parseWhole("1e3"), 1000);
  EXPECT_EQ(parseWhole("9007199254740992"), std::int64_t{1} << 53);
  for (const char* none : {"1.5", "", "0x10", "inf", "nan", "9007199254740994", "1e300"}) {
    EXPECT_FALSE(parseWhole(none)) << "'" << none << "'";
  }
}

TEST(NumberText, SecondsOfWholeNanosecondsAreWrittenAsPeopleDo) {
  EXPECT_EQ(numberText(decimalSeconds(7'500'000)), "0.0075");
  for (std::int64_t us = 0; us < 100'000; us += 100) {
    EXPECT_LE(numberText(decimalSeconds(1000 * us)).size(), 6U) << us;
  }
}

}  // namespace
}  // namespace ballbot
