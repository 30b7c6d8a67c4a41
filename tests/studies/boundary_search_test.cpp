#include "studies/boundary_search.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "studies/study_search.hpp"

namespace ballbot {
namespace {

/// Answers every question of a search from a known share of passes, `count` cases each.
Boundary searched(BoundarySearch search, int count, double (*share)(double), int* asked = nullptr) {
  int questions = 0;
  for (auto wanted = search.next(); !wanted.empty(); wanted = search.next()) {
    for (const double value : wanted) {
      search.tell(value,
                  wilsonInterval(static_cast<int>(std::lround(share(value) * count)), count));
      ++questions;
    }
    EXPECT_LT(questions, 200) << "the search does not end";
    if (questions >= 200) break;
  }
  if (asked) *asked = questions;
  return search.boundary();
}

double stepAt7(double x) { return x >= 7 ? 1 : 0; }
double fallingAt7(double x) { return x >= 7 ? 0 : 1; }
double always(double) { return 1; }
double never(double) { return 0; }
double slope(double x) { return std::min(1.0, std::max(0.0, (x - 6) / 2)); }

TEST(WilsonInterval, AgreesWithPublishedValues) {
  // Brown, Cai, DasGupta (2001) and tables: 5 of 10 and the one-sided ends.
  const RateEstimate half = wilsonInterval(5, 10);
  EXPECT_NEAR(half.low, 0.2366, 1e-4);
  EXPECT_NEAR(half.high, 0.7634, 1e-4);
  EXPECT_NEAR(wilsonInterval(10, 10).low, 0.7225, 1e-4);
  EXPECT_EQ(wilsonInterval(10, 10).high, 1);
  EXPECT_EQ(wilsonInterval(0, 10).low, 0);
  EXPECT_EQ(wilsonInterval(0, 0).high, 1);
}

TEST(WilsonInterval, HoldsTheTrueRateAboutNineteenTimesOfTwenty) {
  // Coverage computed exactly from the binomial distribution, not drawn.
  const int n = 20;
  for (const double p : {0.1, 0.3, 0.5, 0.8}) {
    double covered = 0;
    for (int k = 0; k <= n; ++k) {
      const double log_choose = std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
      const RateEstimate e = wilsonInterval(k, n);
      if (e.low <= p && p <= e.high)
        covered += std::exp(log_choose + k * std::log(p) + (n - k) * std::log1p(-p));
    }
    EXPECT_GT(covered, 0.93) << p;
    EXPECT_LT(covered, 0.985) << p;
  }
}

TEST(BoundarySearch, FindsAStepWithinItsResolution) {
  int asked = 0;
  const Boundary b =
      searched(BoundarySearch({1, 100, true, false}, 0.5, 0.02), 10, stepAt7, &asked);
  ASSERT_EQ(b.kind, Boundary::Kind::kFound);
  EXPECT_TRUE(b.rising);
  EXPECT_NEAR(b.estimate, 7, 0.02 * 7);
  ASSERT_TRUE(b.low && b.high);
  EXPECT_LT(*b.low, 7);
  EXPECT_GE(*b.high, 7);
  EXPECT_LE(*b.high - *b.low, 0.02 * *b.high);
  EXPECT_LT(asked, 14) << "bisection, not a scan";
}

TEST(BoundarySearch, TheIntervalIsAsWideAsTheSlopeAndTheNumberOfCasesMakeIt) {
  const Boundary few = searched(BoundarySearch({1, 100, true, false}, 0.5, 0.01), 10, slope);
  const Boundary many = searched(BoundarySearch({1, 100, true, false}, 0.5, 0.01), 1000, slope);
  ASSERT_TRUE(few.low && few.high && many.low && many.high);
  EXPECT_NEAR(many.estimate, 7, 0.1);
  EXPECT_LT(*few.low, 7);
  EXPECT_GT(*few.high, 7);
  EXPECT_LT(*many.high - *many.low, 0.3 * (*few.high - *few.low));
  // Where the rate is 50 % the interval's ends are half a Wilson interval away on the slope.
  EXPECT_NEAR(*many.high - *many.low,
              2 * (wilsonInterval(500, 1000).high - wilsonInterval(500, 1000).low), 0.3);
}

TEST(BoundarySearch, KnowsAFallingRate) {
  const Boundary b = searched(BoundarySearch({1, 100, true, false}, 0.5, 0.02), 10, fallingAt7);
  ASSERT_EQ(b.kind, Boundary::Kind::kFound);
  EXPECT_FALSE(b.rising);
  EXPECT_NEAR(b.estimate, 7, 0.14);
  EXPECT_LT(*b.low, *b.high);
  EXPECT_THAT(toText(b, 0.5, "Hz"), ::testing::StartsWith("50 % pass below "));
}

TEST(BoundarySearch, SaysWhenThereIsNoBoundary) {
  int asked = 0;
  const BoundarySearch search({1, 100, true, false}, 0.5, 0.02);
  EXPECT_EQ(searched(search, 4, always, &asked).kind, Boundary::Kind::kPassesEverywhere);
  EXPECT_EQ(asked, 2);
  const Boundary none = searched(search, 4, never);
  EXPECT_EQ(none.kind, Boundary::Kind::kPassesNowhere);
  EXPECT_EQ(toText(none, 0.5, "Hz"), "fewer than 50 % pass everywhere in the range");
}

TEST(BoundarySearch, StopsWhereNoCaseRanAndSaysSo) {
  BoundarySearch search({1, 100, true, false}, 0.5, 0.02);
  search.tell(1, wilsonInterval(4, 4));
  search.tell(100, wilsonInterval(0, 0));
  EXPECT_TRUE(search.next().empty());
  EXPECT_EQ(search.boundary().kind, Boundary::Kind::kUnknown);
  EXPECT_THAT(toText(search.boundary(), 0.5, "Hz"), ::testing::HasSubstr("is unknown: none ran"));
}

TEST(BoundarySearch, WithTooFewCasesTheEndsOfTheIntervalAreOpen) {
  const Boundary b = searched(BoundarySearch({1, 100, true, false}, 0.5, 0.02), 2, stepAt7);
  EXPECT_FALSE(b.low);
  EXPECT_FALSE(b.high);
  EXPECT_THAT(toText(b, 0.5, "Hz"),
              ::testing::EndsWith("(95 %: below the range to above the range Hz)"));
}

TEST(BoundarySearch, WholeNumbersStayWhole) {
  BoundarySearch search({0, 50, false, true}, 0.5, 0.001);
  for (auto wanted = search.next(); !wanted.empty(); wanted = search.next()) {
    for (const double value : wanted) {
      EXPECT_EQ(value, std::round(value));
      search.tell(value, wilsonInterval(value >= 7 ? 0 : 10, 10));
    }
  }
  EXPECT_EQ(search.boundary().estimate, 6.5);
}

TEST(BoundaryInAGrid, LiesBetweenTheValuesWhereTheRateCrosses) {
  const Boundary b = boundaryIn({{5, wilsonInterval(0, 5)},
                                 {10, wilsonInterval(2, 5)},
                                 {20, wilsonInterval(3, 5)},
                                 {40, wilsonInterval(5, 5)}},
                                0.5);
  EXPECT_NEAR(b.estimate, std::sqrt(200), 1e-9);
  EXPECT_EQ(*b.low, 5);
  EXPECT_EQ(*b.high, 40);
}

TEST(BoundarySearch, SaysAboutHowMuchIsLeft) {
  BoundarySearch search({0, 64, false, true}, 0.5, 1e-6);
  EXPECT_EQ(search.expectedLeft(), 2 + 6) << "two ends, then 64 is halved six times";
  int left = search.expectedLeft();
  for (auto wanted = search.next(); !wanted.empty(); wanted = search.next()) {
    for (const double value : wanted) search.tell(value, wilsonInterval(value < 40 ? 3 : 0, 3));
    left -= static_cast<int>(wanted.size());
    EXPECT_EQ(search.expectedLeft(), left);
  }
  EXPECT_EQ(left, 0);
  BoundarySearch nothing({0, 64, false, true}, 0.5, 1e-6);
  for (const double end : nothing.next()) nothing.tell(end, wilsonInterval(3, 3));
  EXPECT_EQ(nothing.expectedLeft(), 0) << "passes everywhere";
}

}  // namespace
}  // namespace ballbot
