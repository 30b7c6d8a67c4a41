#include "cosim/disturbance.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using std::chrono::microseconds;
using testing::HasSubstr;
using testing_support::wordsOf;

constexpr std::uint64_t kMessages = 20'000;

std::vector<std::vector<microseconds>> fates(const DisturbanceOptions& options,
                                             const std::string& direction) {
  const Disturbance disturbance(options, direction);
  std::vector<std::vector<microseconds>> all(kMessages);
  for (std::uint64_t i = 0; i < kMessages; ++i) disturbance.decide(i, all[i]);
  return all;
}

TEST(Disturbance, WithoutAnythingEveryMessageGoesThroughAtOnce) {
  for (const auto& copies : fates({}, "requests")) {
    EXPECT_THAT(copies, testing::ElementsAre(microseconds{0}));
  }
}

TEST(Disturbance, SharesAreWhatWasAskedFor) {
  DisturbanceOptions options;
  options.loss = 0.2;
  options.duplication = 0.1;
  options.reordering = 0.3;
  options.delay = microseconds{500};
  options.jitter = microseconds{100};
  double lost = 0, doubled = 0, copies = 0, held = 0;
  for (const auto& fate : fates(options, "requests")) {
    lost += fate.empty() ? 1 : 0;
    doubled += fate.size() == 2 ? 1 : 0;
    for (const microseconds after : fate) {
      EXPECT_GE(after, options.delay);
      EXPECT_LE(after, options.delay + options.jitter + options.reorder_delay);
      held += after >= options.delay + options.reorder_delay ? 1 : 0;
      ++copies;
    }
  }
  // Five standard deviations of a binomial share.
  const auto tolerance = [](double p, double n) { return 5 * std::sqrt(p * (1 - p) / n); };
  EXPECT_NEAR(lost / kMessages, 0.2, tolerance(0.2, kMessages));
  EXPECT_NEAR(doubled / (kMessages - lost), 0.1, tolerance(0.1, kMessages - lost));
  EXPECT_NEAR(held / copies, 0.3, tolerance(0.3, copies));
}

TEST(Disturbance, TheSameSeedDoesTheSameToEachMessageAndAnotherDoesNot) {
  DisturbanceOptions options;
  options.loss = 0.5;
  options.jitter = microseconds{1000};
  const auto once = fates(options, "requests");
  EXPECT_EQ(fates(options, "requests"), once);
  EXPECT_NE(fates(options, "replies"), once);
  options.seed = 2;
  EXPECT_NE(fates(options, "requests"), once);
}

TEST(Disturbance, ImpossibleFiguresAreRefused) {
  DisturbanceOptions options;
  options.loss = 1.5;
  EXPECT_EQ(wordsOf<InputError>([&] { Disturbance(options, "x"); }),
            "loss is 1.5, must be between 0 and 1");
  options.loss = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(wordsOf<InputError>([&] { Disturbance(options, "x"); }),
              HasSubstr("loss is nan, must be between 0 and 1"));
  options.loss = 0;
  options.jitter = microseconds{-1};
  EXPECT_EQ(wordsOf<InputError>([&] { Disturbance(options, "x"); }),
            "jitter is -1 us, must not be negative");
}

}  // namespace
}  // namespace ballbot
