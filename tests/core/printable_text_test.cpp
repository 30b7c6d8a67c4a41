#include "core/printable_text.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(PrintableText, KeepsWhatPeopleWrite) {
  const std::string text = "line one\nπ ≈ 3.14, größer 日本 \xF0\x9F\x99\x82 ~";
  EXPECT_EQ(printableText(text), text);
}

TEST(PrintableText, TakesTheMeaningFromControlCharacters) {
  EXPECT_EQ(printableText("\x1B]0;title\x07\x1B[2J\r\b\x7F\t"), "?]0;title??[2J????");
  EXPECT_EQ(printableText("\xC2\x9B\x32J"), "??2J");  // ESC [ as one character of C1
  EXPECT_EQ(printableText("a\xE2\x80\xAE"
                          "b"),
            "a???b");  // writes backwards from here on
  EXPECT_EQ(printableText(std::string("a\0b", 3)), "a?b");
}

TEST(PrintableText, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printableText("\xFF\xC0\x80"), "???");
  EXPECT_EQ(printableText("cut \xE2\x82"), "cut ??");
  EXPECT_EQ(printableText("\xED\xA0\x80"), "???");       // half of a surrogate pair
  EXPECT_EQ(printableText("\xF4\x90\x80\x80"), "????");  // beyond the last character
  EXPECT_EQ(printableText("\xE0\x80\xAF"), "???");       // '/' written too long
}

}  // namespace
}  // namespace ballbot
