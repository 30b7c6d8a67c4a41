// A million damaged, truncated and random lines at both ends of the serial line. Whatever passes
// must be a frame that reads back to the very line that came.
#include <cctype>
#include <string>

#include <gtest/gtest.h>

#include "hil/emulator/slcan_adapter.hpp"
#include "hil/slcan_codec.hpp"
#include "tests/hil/support/random_bytes.hpp"

namespace ballbot {
namespace {

constexpr int kLines = 1'000'000;

std::string encoded(const CanFrame& frame) {
  std::array<char, kSlcanLineMax> line;
  return {line.data(), encodeSlcan(frame, line)};
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// A good line, spoilt in one of several ways, or pure rubbish.
std::string spoilt(RandomBytes& random) {
  std::string line = encoded(random.frame());
  switch (random.below(6)) {
    case 0:
      return line;
    case 1:
      line.resize(random.below(static_cast<std::uint32_t>(line.size())));
      break;
    case 2:
      line[random.below(static_cast<std::uint32_t>(line.size()))] =
          static_cast<char>(random.byte());
      break;
    case 3:
      line.insert(random.below(static_cast<std::uint32_t>(line.size())), 1,
                  static_cast<char>(random.byte()));
      break;
    case 4:
      line.erase(random.below(static_cast<std::uint32_t>(line.size())), 1);
      break;
    default:
      line.resize(random.below(60));
      for (char& c : line) c = static_cast<char>(random.byte());
  }
  return line + '\r';
}

TEST(SlcanFuzz, TheHostTakesOnlyWhatReadsBackToTheSameLine) {
  RandomBytes random(1);
  SlcanParser parser;
  std::string since;  // characters of the line that is being read
  std::int64_t frames = 0;
  for (int i = 0; i < kLines; ++i) {
    for (const char c : spoilt(random)) {
      if (c != '\r' && c != '\a' && (c != '\n' || !since.empty())) since += c;
      const SlcanParser::Item item = parser.take(c);
      if (item == SlcanParser::Item::kNone) continue;
      if (item == SlcanParser::Item::kFrame) {
        ++frames;
        ASSERT_TRUE(isValid(parser.frame()));
        const std::string back = encoded(parser.frame());
        // A time stamp may follow; nothing else may differ but the case of hexadecimal digits.
        const std::string bare = back.substr(0, back.size() - 1);
        ASSERT_EQ(upper(since).compare(0, bare.size(), upper(bare)), 0) << since;
        const std::size_t stamp = since.size() - bare.size();
        ASSERT_TRUE(stamp == 0 || stamp == 4 || stamp == 8) << since;
      }
      since.clear();
    }
  }
  EXPECT_GT(frames, kLines / 7) << "good lines between the bad ones must still arrive";
}

TEST(SlcanFuzz, TheAdapterTakesOnlyWhatReadsBackToTheSameLine) {
  RandomBytes random(2);
  SlcanAdapter adapter;
  std::string reply;
  CanFrame sent;
  for (const char c : std::string("O\r")) adapter.take(c, reply, sent);
  std::string since;
  std::int64_t frames = 0;
  for (int i = 0; i < kLines; ++i) {
    for (const char c : spoilt(random)) {
      if (c != '\r' && c != '\n') since += c;
      const bool took = adapter.take(c, reply, sent);
      if (took) {
        ++frames;
        ASSERT_TRUE(isValid(sent));
        ASSERT_EQ(upper(since) + '\r', upper(encoded(sent)));
      }
      if (c == '\r') since.clear();
    }
    if (!adapter.isOpen()) {  // a random C
      for (const char c : std::string("O\r")) adapter.take(c, reply, sent);
    }
    reply.clear();
  }
  EXPECT_GT(frames, kLines / 7);
}

TEST(SlcanFuzz, WhatOneEndWritesTheOtherReads) {
  RandomBytes random(3);
  SlcanAdapter adapter;
  SlcanParser parser;
  std::string reply;
  CanFrame sent;
  for (const char c : std::string("O\r")) adapter.take(c, reply, sent);
  for (int i = 0; i < 100'000; ++i) {
    const CanFrame frame = random.frame();
    bool took = false;
    for (const char c : encoded(frame)) took = adapter.take(c, reply, sent) || took;
    ASSERT_TRUE(took);
    ASSERT_EQ(sent, frame);
    reply.clear();
    adapter.show(frame, i, reply);
    SlcanParser::Item item = SlcanParser::Item::kNone;
    for (const char c : reply) item = parser.take(c);
    ASSERT_EQ(item, SlcanParser::Item::kFrame);
    ASSERT_EQ(parser.frame(), frame);
    reply.clear();
  }
}

}  // namespace
}  // namespace ballbot
