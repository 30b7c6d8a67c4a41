#include "cosim/lcm_url.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::wordsOf;

std::string refusal(const std::string& rest) {
  return wordsOf<InputError>([&] { LcmUrl::parse("udpm://239.255.76.67" + rest); });
}

TEST(LcmUrl, ReadsAddressAndOptions) {
  const LcmUrl plain = LcmUrl::parse("udpm://239.255.76.67:7667");
  EXPECT_EQ(plain.network(), "239.255.76.67:7667");
  EXPECT_EQ(plain.ttl, 0);
  EXPECT_EQ(plain.receive_buffer_bytes, 2 << 20);
  const LcmUrl full = LcmUrl::parse("udpm://224.0.0.1:65535?ttl=255&recv_buf_size=100000");
  EXPECT_EQ(full.network(), "224.0.0.1:65535");
  EXPECT_EQ(full.ttl, 255);
  EXPECT_EQ(full.receive_buffer_bytes, 100'000);
}

TEST(LcmUrl, TakesATtlOf0To255InDigitsOnly) {
  for (const char* ttl :
       {"-1", "256", "300", "1.0", "0x1", "+1", " 1", "", "99999999999999999999"}) {
    EXPECT_THAT(
        refusal(std::string(":7667?ttl=") + ttl),
        HasSubstr(std::string("ttl is '") + ttl + "', must be a whole number from 0 to 255"));
  }
}

TEST(LcmUrl, KnowsItsOptions) {
  EXPECT_THAT(refusal(":7667?tll=0"),
              HasSubstr("unknown option 'tll'; there are ttl and recv_buf_size"));
  EXPECT_THAT(refusal(":7667?"), HasSubstr("unknown option ''"));
  EXPECT_THAT(refusal(":7667?ttl=0&"), HasSubstr("unknown option ''"));
  EXPECT_THAT(refusal(":7667?ttl=0&ttl=1"), HasSubstr("option 'ttl' stands there twice"));
  EXPECT_THAT(refusal(":7667?recv_buf_size=0"), HasSubstr("must be a whole number from 1 to 2147"));
}

TEST(LcmUrl, WantsAPortInDigits) {
  for (const char* port : {":", ":0", ":65536", ": 7667", ":+7667", ":7667x"}) {
    EXPECT_THAT(refusal(port), HasSubstr("the port must be 1 to 65535"));
  }
  EXPECT_THAT(refusal(""), HasSubstr("no port"));
}

}  // namespace
}  // namespace ballbot
