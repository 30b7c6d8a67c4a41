#include "report/base64.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

/// Decoder of its own, by looking letters up: shares nothing with the encoder.
std::vector<float> decoded(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<bool> bits;
  for (const char c : text) {
    if (c == '=') break;
    const auto value = alphabet.find(c);
    EXPECT_NE(value, std::string::npos) << c;
    for (int bit = 5; bit >= 0; --bit) bits.push_back((value >> bit & 1u) != 0);
  }
  std::vector<float> values(bits.size() / 32);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t word = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) {
      for (std::size_t bit = 0; bit < 8; ++bit) {
        if (bits[32 * i + 8 * byte + bit]) word |= 1u << (8 * byte + 7 - bit);
      }
    }
    std::memcpy(&values[i], &word, sizeof word);
  }
  return values;
}

TEST(Base64Float32, IsLittleEndianAndPadded) {
  EXPECT_EQ(base64Float32({}), "");
  EXPECT_EQ(base64Float32({1.0}), "AACAPw==");
  EXPECT_EQ(base64Float32({1.0, -2.0}), "AACAPwAAAMA=");
}

TEST(Base64Float32, GivesBackTheNearestFloat) {
  for (std::size_t count = 0; count < 8; ++count) {
    std::vector<double> values;
    for (int i = 0; i < static_cast<int>(count); ++i)
      values.push_back(std::sin(1.7 * i) * std::pow(10, i));
    const std::vector<float> back = decoded(base64Float32(values));
    ASSERT_EQ(back.size(), count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(back[i], static_cast<float>(values[i]));
  }
}

TEST(Base64Float32, MakesOneNanOfEverythingThatIsNotFinite) {
  const std::string nan = base64Float32({std::numeric_limits<double>::quiet_NaN()});
  EXPECT_TRUE(std::isnan(decoded(nan).at(0)));
  for (const double value : {-std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e300, -1e300})
    EXPECT_EQ(base64Float32({value}), nan) << value;
}

}  // namespace
}  // namespace ballbot
