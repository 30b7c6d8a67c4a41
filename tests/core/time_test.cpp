#include "core/time.hpp"

#include <gtest/gtest.h>

#include "core/digest.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

TEST(Time, RoundsSecondsToTheNearestNanosecond) {
  EXPECT_EQ(durationFromSeconds(0.01).count(), 10'000'000);
  EXPECT_EQ(durationFromSeconds(0.009999999999999998).count(), 10'000'000);
  EXPECT_THROW(durationFromSeconds(1e300), InputError);
}

TEST(Time, SpeaksInTheUnitAPersonWouldUse) {
  EXPECT_EQ(toText(SimDuration{400'000}), "400 us");
  EXPECT_EQ(toText(SimDuration{14'000'000}), "14 ms");
  EXPECT_EQ(toText(SimDuration{2'500'000}), "2.5 ms");
  EXPECT_EQ(toText(SimDuration{3'000'000'000}), "3 s");
  EXPECT_EQ(toText(SimDuration{7}), "7 ns");
}

TEST(Digest, DependsOnBytesNotOnHowTheyArrive) {
  Digest whole, parts;
  whole.add("abcdef", 6);
  parts.add("abc", 3);
  parts.add("def", 3);
  EXPECT_EQ(whole.hex(), parts.hex());
  const Digest copy(parts);
  parts.add("x", 1);
  EXPECT_EQ(copy.hex(), whole.hex());
  EXPECT_NE(parts.hex(), whole.hex());
}

}  // namespace
}  // namespace ballbot
