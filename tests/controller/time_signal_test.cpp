#include "controller/time_signal.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/config_listing.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using Signal2 = TimeSignal<2>;

Signal2 signalFrom(const char* yaml) {
  const ConfigNode tree = parseYaml(yaml, "scenario.yaml");
  ConfigReader in(tree);
  Signal2 signal(Eigen::Vector2d(1, 2));
  readDescribed(in, signal);
  in.finish();
  return signal;
}

TEST(TimeSignal, AddsStepsAndRamps) {
  const Signal2 s = signalFrom(
      "{moves: [{at_s: 2, by: [0.5, 0]}, {at_s: 4, by: [0, 1], over_s: 2}, {at_s: 5, by: 1}]}");
  EXPECT_EQ(s.value(1.999), Eigen::Vector2d(1, 2));
  EXPECT_EQ(s.value(2), Eigen::Vector2d(1.5, 2));
  EXPECT_EQ(s.value(4.5), Eigen::Vector2d(1.5, 2.25));
  EXPECT_EQ(s.value(5), Eigen::Vector2d(2.5, 3.5));
  EXPECT_EQ(s.value(100), Eigen::Vector2d(2.5, 4));
  EXPECT_EQ(s.rate(4.5), Eigen::Vector2d(0, 0.5));
  EXPECT_EQ(s.rate(7), Eigen::Vector2d(0, 0));
}

TEST(TimeSignal, ACircleComesBackAndItsRateIsItsDerivative) {
  const Signal2 s = signalFrom("{moves: [{at_s: 1, circle_radius_m: 0.5, period_s: 8, turns: 2}]}");
  EXPECT_LT((s.value(1 + 4) - Eigen::Vector2d(0, 2)).norm(), 1e-12) << "half a turn";
  EXPECT_LT((s.value(1 + 16) - Eigen::Vector2d(1, 2)).norm(), 1e-12);
  EXPECT_LT((s.value(40) - Eigen::Vector2d(1, 2)).norm(), 1e-12);
  const double h = 1e-6;
  for (double t : {1.5, 3.0, 9.0}) {
    EXPECT_LT((s.rate(t) - (s.value(t + h) - s.value(t - h)) / (2 * h)).norm(), 1e-8);
  }
}

TEST(TimeSignal, AStepIsUnknownUntilItComesAndARampIsKnownAhead) {
  const Signal2 s =
      signalFrom("{moves: [{at_s: 2, by: [1, 0]}, {at_s: 4, by: [0, 1], over_s: 2}]}");
  EXPECT_EQ(s.value(3, 1.9), Eigen::Vector2d(1, 2));
  EXPECT_EQ(s.value(3, 2.0), Eigen::Vector2d(2, 2));
  EXPECT_EQ(s.value(5, 1.9), Eigen::Vector2d(1, 2.5));
}

TEST(TimeSignal, SaysWhichOfItsMovesAreStepsAndWhereItTurns) {
  const Signal2 s = signalFrom(
      "{moves: [{at_s: 2, by: [1, 0]}, {at_s: 4, by: [0, 1], over_s: 2},"
      " {at_s: 8, circle_radius_m: 1, period_s: 8}]}");
  ASSERT_EQ(s.steps().size(), 1u);
  EXPECT_EQ(s.steps()[0].at, 2);
  EXPECT_EQ(s.steps()[0].by, Eigen::Vector2d(1, 0));
  EXPECT_TRUE(s.moves());
  EXPECT_FALSE(Signal2().moves());
  double leftmost = 0, highest = 0;
  for (const double t : s.turningTimes()) {
    leftmost = std::min(leftmost, s.value(t).x());
    highest = std::max(highest, s.value(t).y());
  }
  EXPECT_NEAR(leftmost, 2 - 2, 1e-9) << "of the circle about (1, 3)";
  EXPECT_NEAR(highest, 4, 1e-9);
}

std::string errorOf(const char* yaml) {
  try {
    signalFrom(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(TimeSignal, KnowsOfAMoveOnlyWhatBelongsToIt) {
  EXPECT_THAT(errorOf("{moves: [{at_s: 1}]}"), HasSubstr("key 'by' is missing in 'moves.0'"));
  EXPECT_THAT(errorOf("{moves: [{at_s: 1, circle_radius_m: 1}]}"),
              HasSubstr("key 'period_s' is missing in 'moves.0'"));
  EXPECT_THAT(errorOf("{moves: [{at_s: 1, circle_radius_m: 1, period_s: 4, by: [1, 0]}]}"),
              HasSubstr("unknown key 'by' in 'moves.0'"));
  EXPECT_THAT(errorOf("{moves: [{at_s: 1, by: [1, 0], turns: 2}]}"),
              HasSubstr("unknown key 'turns' in 'moves.0'"));
}

TEST(TimeSignal, StaysAsItIsWhenItIsListed) {
  Signal2 s(Eigen::Vector2d(1, 2));
  ConfigListing listing;
  s.describe(listing);
  EXPECT_EQ(listing.take().size(), 8U);
  EXPECT_FALSE(s.moves());
  EXPECT_EQ(s.value(1), Eigen::Vector2d(1, 2));

  TimeSignal<1> heading;
  ConfigListing of_heading;
  heading.describe(of_heading);
  for (const KeyEntry& e : of_heading.take()) EXPECT_NE(e.path, "moves.0.circle_radius_m");
}

TEST(TimedWeight, SwitchesATaskOnAndOff) {
  const ConfigNode tree = parseYaml(
      "{weight: 0, weight_changes: [{at_s: 2, weight: [1, 2]}, {at_s: 3, weight: 0}]}", "s.yaml");
  ConfigReader in(tree);
  TimedWeight<2> w;
  readDescribed(in, w);
  EXPECT_EQ(w.value(1.9), Eigen::Vector2d(0, 0));
  EXPECT_EQ(w.value(2), Eigen::Vector2d(1, 2));
  EXPECT_EQ(w.value(3), Eigen::Vector2d(0, 0));
  EXPECT_EQ(w.value(2.5, 1.5), Eigen::Vector2d(0, 0)) << "not known yet";
}

TEST(TimedWeight, RefusesChangesOutOfOrder) {
  const ConfigNode tree = parseYaml(
      "{weight: 0, weight_changes: [{at_s: 3, weight: 1}, {at_s: 2, weight: 0}]}", "s.yaml");
  ConfigReader in(tree);
  try {
    TimedWeight<2> w;
    readDescribed(in, w);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("at_s is 2, must be later than the change before it, at 3 s"));
  }
}

}  // namespace
}  // namespace ballbot
