#include "metrics/push_metrics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

TruthFrame ball(double t, double y) {
  TruthFrame truth;
  truth.time = at(t);
  truth.state[kBallY] = y;
  return truth;
}

TEST(PushMetrics, MeasuresExcursionAndReturnOfADecay) {
  PushMetrics metrics({{at(2), at(2.5)}});
  // Away by 0.4 m when the push ends, then back as exp(-t): 5 cm are reached ln(8) s later.
  for (double t = 0; t < 10; t += 1e-3) {
    metrics.add(ball(t, 1 + (t < 2     ? 0
                             : t < 2.5 ? 0.8 * (t - 2)
                                       : 0.4 * std::exp(-(t - 2.5)))),
                {});
  }
  EXPECT_NEAR(metrics.values().at("largest_push_excursion_m"), 0.4, 1e-3);
  EXPECT_NEAR(metrics.values().at("longest_push_return_s"), std::log(8.0), 2e-3);
}

TEST(PushMetrics, ABallThatStaysAwayHasNoReturnTime) {
  PushMetrics metrics({{at(1), at(1.5)}});
  for (double t = 0; t < 5; t += 1e-2) metrics.add(ball(t, t < 1.1 ? 0 : 0.2), {});
  EXPECT_NEAR(metrics.values().at("largest_push_excursion_m"), 0.2, 1e-9);
  EXPECT_EQ(metrics.values().count("longest_push_return_s"), 0u);
}

TEST(PushMetrics, EachPushIsJudgedFromWhereItBegan) {
  PushMetrics metrics({{at(1), at(1.5)}, {at(3), at(3.5)}});
  for (double t = 0; t < 5; t += 1e-2) {
    metrics.add(ball(t, t < 1.1 ? 0 : t < 1.2 ? 0.1 : t < 3.1 ? 0.04 : t < 3.6 ? 0.24 : 0.04), {});
  }
  EXPECT_NEAR(metrics.values().at("largest_push_excursion_m"), 0.2, 1e-9);
  EXPECT_NEAR(metrics.values().at("longest_push_return_s"), 0.1, 0.02);
}

TEST(PushMetrics, JudgesTheEndEffectorFromWhereItWas) {
  PushMetrics metrics({{at(1), at(1.5)}});
  for (double t = 0; t < 5; t += 1e-2) {
    TruthFrame truth = ball(t, 0);
    truth.p_WE << 0.2, 0, t > 1.2 && t < 2.5 ? 0.85 : 0.95;
    truth.state[kArm1 + 1] = t > 1.2 && t < 1.4 ? -0.9 : -0.6;
    metrics.add(truth, {});
  }
  EXPECT_NEAR(metrics.values().at("largest_push_ee_excursion_m"), 0.1, 1e-9);
  EXPECT_NEAR(metrics.values().at("longest_push_ee_return_s"), 1, 0.02);
  EXPECT_NEAR(metrics.values().at("largest_push_arm_excursion_rad"), 0.3, 1e-9);
}

TEST(PushMetrics, LeanCountsAgainstThePushOnlyAndFromTheLeanBefore) {
  const auto leanUnder = [](double roll) {
    PushMetrics metrics({{at(1), at(1.5), {0, 20}}});
    for (double t = 0; t < 3; t += 1e-2) {
      TruthFrame truth = ball(t, 0);
      truth.state[kPitch] = 0.02;  // the equilibrium's, across the push
      truth.state[kRoll] = t > 1.2 ? roll : 0;
      metrics.add(truth, {});
    }
    return metrics.values().at("least_lean_against_push_deg");
  };
  // A positive roll turns z_B towards -y: against a push along +y.
  EXPECT_NEAR(leanUnder(0.1), 0.1 * 180 / M_PI, 0.02);
  EXPECT_NEAR(leanUnder(-0.1), 0, 1e-9);
}

TEST(PushMetrics, WithoutPushesThereIsNothingToSay) {
  PushMetrics metrics({});
  metrics.add(ball(1, 1), {});
  EXPECT_TRUE(metrics.values().empty());
}

TEST(PushMetrics, APushThatTheStandTakesIsNone) {
  PushMetrics held({{at(0), at(0.4), {200, 0}}}, at(0.5));
  PushMetrics partly({{at(0), at(1), {200, 0}}}, at(0.5));
  for (double t = 0; t < 5; t += 1e-2) {
    const double y = t < 0.6 ? 0 : t < 2 ? 0.2 : 0.01;
    held.add(ball(t, y), {});
    partly.add(ball(t, y), {});
  }
  EXPECT_TRUE(held.values().empty());
  EXPECT_NEAR(partly.values().at("longest_push_return_s"), 1, 0.02) << "from its end at 1 s";
}

TEST(PushMetrics, ARunThatEndsWithinAPushSawNoReturn) {
  PushMetrics metrics({{at(1), at(2)}});
  for (double t = 0; t < 1.5; t += 1e-2) metrics.add(ball(t, 0), {});
  EXPECT_EQ(metrics.values().count("longest_push_return_s"), 0u);
  EXPECT_EQ(metrics.values().count("longest_push_ee_return_s"), 0u);
  EXPECT_EQ(metrics.values().count("largest_push_excursion_m"), 1u);
}

TEST(PushMetrics, OfARunThatContinuesAnotherOnlyItsOwnPushesCount) {
  PushMetrics metrics({{at(1), at(2)}});
  for (double t = 1.5; t < 5; t += 1e-2) metrics.add(ball(t, 1), {});
  EXPECT_TRUE(metrics.values().empty());
}

TEST(PushMetrics, PushesThatOverlapActWithTheSumOfTheirImpulses) {
  PushMetrics metrics({{at(1), at(2), {0, 0}}, {at(1.5), at(2), {0, 15}}});
  for (double t = 0; t < 4; t += 1e-2) {
    TruthFrame truth = ball(t, 0);
    truth.state[kRoll] = t > 1.6 ? 0.1 : 0;  // towards -y
    metrics.add(truth, {});
  }
  EXPECT_NEAR(metrics.values().at("least_lean_against_push_deg"), 0.1 * 180 / M_PI, 0.02);
}

/// A circle of half a metre in ten seconds.
PlaceReference circling(double t) {
  PlaceReference place;
  place.ball << 0.5 * std::cos(0.2 * M_PI * t), 0.5 * std::sin(0.2 * M_PI * t);
  place.ball_asked.setOnes();
  return place;
}

TEST(PushMetrics, TheBallComesBackToItsReferenceAlsoWhereThatMoves) {
  PushMetrics metrics({{at(2), at(2.5)}});
  for (double t = 0; t < 10; t += 1e-3) {
    const PlaceReference place = circling(t);
    TruthFrame truth;
    truth.time = at(t);
    truth.state.segment<2>(kBallX) = place.ball;
    // Driven away by 0.4 m, back as exp(-t); 2 cm behind before, as one may be.
    truth.state[kBallX] += 0.02 + (t < 2 ? 0 : t < 2.5 ? 0.8 * (t - 2) : 0.4 * std::exp(2.5 - t));
    metrics.add(truth, place);
  }
  EXPECT_NEAR(metrics.values().at("largest_push_excursion_m"), 0.4, 1e-3);
  EXPECT_NEAR(metrics.values().at("longest_push_return_s"), std::log(0.4 / 0.03), 2e-3);
}

TEST(PushMetrics, AStepOfTheReferenceEndsTheWayBack) {
  PushMetrics metrics({{at(1), at(1.5)}});
  for (double t = 0; t < 8; t += 1e-2) {
    PlaceReference place;
    place.ball_asked.setOnes();
    place.ball.y() = t < 5 ? 0 : 1;
    metrics.add(ball(t, t < 1 ? 0 : t < 2.5 ? 0.2 : 0), place);
  }
  EXPECT_NEAR(metrics.values().at("longest_push_return_s"), 1, 0.02);
  EXPECT_NEAR(metrics.values().at("largest_push_excursion_m"), 0.2, 1e-9);
}

}  // namespace
}  // namespace ballbot
