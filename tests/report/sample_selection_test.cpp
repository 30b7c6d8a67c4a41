#include "report/sample_selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ballbot {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

std::vector<double> wave(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = std::sin(0.01 * static_cast<double>(i));
  return values;
}

TEST(SelectExtremes, KeepsEverythingThatFits) {
  const std::vector<double> values = wave(5);
  EXPECT_THAT(selectExtremes({&values}, 5), ElementsAre(0, 1, 2, 3, 4));
  const std::vector<double> none;
  EXPECT_TRUE(selectExtremes({&none}, 5).empty());
}

TEST(SelectExtremes, KeepsAscendingSamplesWithBothEndsAndNotManyMoreThanAsked) {
  const std::vector<double> a = wave(10000), b(10000, 1.0);
  const auto kept = selectExtremes({&a, &b}, 400);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), 9999u);
  EXPECT_LE(kept.size(), 402u);
  EXPECT_GE(kept.size(), 200u);
}

TEST(SelectExtremes, KeepsASpikeOfOneSampleInAnyColumn) {
  for (const std::size_t at : {1u, 4321u, 7500u, 9998u}) {
    std::vector<double> quiet = wave(10000), high = quiet, low = quiet;
    high[at] = 5;
    low[at] = -5;
    EXPECT_THAT(selectExtremes({&quiet, &high}, 200), Contains(at));
    EXPECT_THAT(selectExtremes({&low, &quiet}, 200), Contains(at));
  }
}

TEST(SelectExtremes, KeepsAGapSoThatTheLineStillBreaks) {
  std::vector<double> values = wave(10000);
  values[5000] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(selectExtremes({&values}, 200), Contains(5000u));
  const std::vector<double> all_gap(1000, std::numeric_limits<double>::quiet_NaN());
  EXPECT_GE(selectExtremes({&all_gap}, 10).size(), 2u);
}

TEST(SelectSpaced, KeepsEveryTenthOfAnEvenClockAndBothEnds) {
  std::vector<double> t;
  for (int i = 0; i <= 1003; ++i) t.push_back(i * 0.0025);
  const auto kept = selectSpaced(t, 0.025);
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) EXPECT_EQ(kept[i], 10 * i);
  EXPECT_EQ(kept.back(), 1003u);
}

TEST(SelectSpaced, KeepsAClockSlowerThanAsked) {
  EXPECT_THAT(selectSpaced({0, 0.1, 0.2}, 0.05), ElementsAre(0, 1, 2));
  EXPECT_TRUE(selectSpaced({}, 0.05).empty());
}

}  // namespace
}  // namespace ballbot
