#include "metrics/ee_step_metrics.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

/// Second-order response with damping ratio z and natural frequency w to a unit step at time 0.
double secondOrder(double t, double z, double w) {
  if (t < 0) return 0;
  const double wd = w * std::sqrt(1 - z * z);
  return 1 - std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
}

TEST(StepResponse, FindsRiseAndOvershootOfASecondOrderSystem) {
  const double z = 0.5, w = 4;
  StepResponse response(at(1), at(9), -0.2, 0.8);
  for (double t = 0; t < 10; t += 1e-3) response.add(at(t), 1 - 0.2 * secondOrder(t - 1, z, w));
  // Closed form of the overshoot; the rise time solves secondOrder(t) = 0.9.
  EXPECT_NEAR(response.overshootPercent(), 100 * std::exp(-M_PI * z / std::sqrt(1 - z * z)), 0.05);
  EXPECT_NEAR(secondOrder(*response.riseTime(), z, w), 0.9, 2e-3);
  EXPECT_NEAR(*response.remainingError(), 0, 1e-4);
  EXPECT_NEAR(response.againstFirst(), 0, 1e-12);
}

TEST(StepResponse, SeesMotionAgainstTheStepOnlyBeforeTheRise) {
  StepResponse response(at(0), at(10), 1, 1);
  for (double t = 0; t < 10; t += 1e-3) {
    response.add(at(t), t < 1 ? -0.3 * std::sin(M_PI * t) : t < 2 ? t - 1 : t < 5 ? 1 : 0.2);
  }
  EXPECT_NEAR(response.againstFirst(), 0.3, 1e-5);
  EXPECT_NEAR(*response.remainingError(), -0.8, 1e-9);
}

TEST(StepResponse, WhatIsNeverReachedHasNoRiseTime) {
  StepResponse response(at(0), at(5), 1, 1);
  for (double t = 0; t < 5; t += 1e-2) response.add(at(t), 0.5);
  EXPECT_FALSE(response.riseTime().has_value());
}

TEST(EeStepMetrics, JudgesEachComponentInItsOwnWindow) {
  EeStep x{at(1), PoseVector::Zero()}, roll{at(5), PoseVector::Zero()};
  x.by[0] = 0.3;
  roll.by[5] = 0.35;
  EeStepMetrics metrics(PoseVector::Zero(), {roll, x}, at(9));
  for (int k = 0; k < 900; ++k) {
    const double t = 0.01 * k;
    TruthFrame truth;
    truth.time = at(t);
    truth.p_WE.x() = 0.3 * secondOrder(t - 1, 0.9, 5);
    truth.state[kBallX] = t > 1 && t < 1.3 ? -0.05 : truth.p_WE.x();
    const double r = t > 5 ? 0.007 : 0;
    truth.quat_WE << std::cos(r / 2), std::sin(r / 2), 0, 0;
    metrics.add(truth);
  }
  const auto values = metrics.values();
  EXPECT_NEAR(secondOrder(values.at("ee_x_rise_s"), 0.9, 5), 0.9, 0.02);
  EXPECT_LT(values.at("ee_x_overshoot_percent"), 0.3);
  EXPECT_NEAR(values.at("ball_backs_up_m"), 0.05, 1e-3);
  EXPECT_NEAR(values.at("ee_roll_given_percent"), 2, 1e-6);
  EXPECT_EQ(values.count("ee_y_rise_s"), 0u);
  const auto names = EeStepMetrics::names();
  for (const auto& value : values) EXPECT_EQ(std::count(names.begin(), names.end(), value.first), 1) << value.first;
}

}  // namespace
}  // namespace ballbot
