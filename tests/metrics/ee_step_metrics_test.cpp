#include "metrics/ee_step_metrics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "model/frames.hpp"

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
  StepResponse response(at(1), at(9), -0.2);
  for (double t = 0; t < 10; t += 1e-3) response.add(at(t), 0.2 - 0.2 * secondOrder(t - 1, z, w));
  // Closed form of the overshoot; the rise time solves secondOrder(t) = 0.9.
  EXPECT_NEAR(response.overshootPercent(), 100 * std::exp(-M_PI * z / std::sqrt(1 - z * z)), 0.05);
  EXPECT_NEAR(secondOrder(*response.riseTime(), z, w), 0.9, 2e-3);
  EXPECT_NEAR(*response.remainingError(), 0, 1e-4);
  EXPECT_NEAR(response.againstFirst(), 0, 1e-12);
}

TEST(StepResponse, SeesMotionAgainstTheStepOnlyBeforeTheRise) {
  StepResponse response(at(0), at(10), 1);
  for (double t = 0; t < 10; t += 1e-3) {
    response.add(at(t), (t < 1 ? -0.3 * std::sin(M_PI * t) : t < 2 ? t - 1 : t < 5 ? 1 : 0.2) - 1);
  }
  EXPECT_NEAR(response.againstFirst(), 0.3, 1e-5);
  EXPECT_NEAR(*response.remainingError(), -0.8, 1e-9);
}

TEST(StepResponse, WhatIsNeverReachedHasNoRiseTime) {
  StepResponse response(at(0), at(5), 1);
  for (double t = 0; t < 5; t += 1e-2) response.add(at(t), -0.5);
  EXPECT_FALSE(response.riseTime().has_value());
}

TEST(StepResponse, HalfATurnMayBeMadeEitherWayRound) {
  for (const double way : {1.0, -1.0}) {
    StepResponse response(at(1), at(9), M_PI, StepResponse::Kind::kAngle);
    for (double t = 0; t < 10; t += 1e-3) {
      const double noise = 1e-3 * std::sin(300 * t);  // at the start it is as near either way
      const double angle = way * M_PI * secondOrder(t - 1, 0.5, 4) + noise;
      response.add(at(t), std::remainder(angle - M_PI, 2 * M_PI));
    }
    EXPECT_NEAR(secondOrder(*response.riseTime(), 0.5, 4), 0.9, 3e-3);
    EXPECT_NEAR(response.overshootPercent(), 100 * std::exp(-M_PI * 0.5 / std::sqrt(0.75)), 0.1);
    EXPECT_NEAR(*response.remainingError(), 0, 1e-3);
  }
}

TEST(StepResponse, AnErrorOfHalfATurnDoesNotAverageToNone) {
  StepResponse response(at(0), at(2), M_PI, StepResponse::Kind::kAngle);
  for (double t = 0; t < 2; t += 1e-3) {
    response.add(at(t), std::remainder(0.01 * std::sin(300 * t) - M_PI, 2 * M_PI));
  }
  EXPECT_NEAR(std::abs(*response.remainingError()), M_PI, 1e-3);
}

TEST(EeStepMetrics, JudgesEachComponentInItsOwnWindow) {
  EeStep x{at(1), PoseVector::Zero()}, roll{at(5), PoseVector::Zero()};
  x.by[0] = 0.3;
  roll.by[5] = 0.35;
  EeStepMetrics metrics({roll, x}, kSimStart, at(9));
  for (int k = 0; k < 900; ++k) {
    const double t = 0.01 * k;
    TruthFrame truth;
    truth.time = at(t);
    truth.p_WE.x() = 0.3 * secondOrder(t - 1, 0.9, 5);
    truth.state[kBallX] = t > 1 && t < 1.3 ? -0.05 : truth.p_WE.x();
    const double r = t > 5 ? 0.007 : 0;
    truth.quat_WE << std::cos(r / 2), std::sin(r / 2), 0, 0;
    metrics.add(truth, (t >= 1) * x.by + (t >= 5) * roll.by);
  }
  const auto values = metrics.values();
  EXPECT_NEAR(secondOrder(values.at("ee_x_rise_s"), 0.9, 5), 0.9, 0.02);
  EXPECT_LT(values.at("ee_x_overshoot_percent"), 0.3);
  EXPECT_NEAR(values.at("ball_backs_up_m"), 0.05, 1e-3);
  EXPECT_NEAR(values.at("ee_roll_given_percent"), 2, 1e-6);
  EXPECT_EQ(values.count("ee_y_rise_s"), 0u);
  const auto names = EeStepMetrics::names();
  for (const auto& value : values)
    EXPECT_EQ(std::count(names.begin(), names.end(), value.first), 1) << value.first;
}

EeStep stepOf(double t, int component, double by) {
  EeStep step{at(t), PoseVector::Zero()};
  step.by[component] = by;
  return step;
}

/// What is measured of an end-effector that follows `steps` with a first-order lag of 0.2 s in the
/// angles, until `end`.
std::map<std::string, double> followed(const std::vector<EeStep>& steps, double end,
                                       double release = 0) {
  EeStepMetrics metrics(steps, at(release), at(10));
  PoseVector pose = PoseVector::Zero();
  for (double t = 0; t < end; t += 1e-2) {
    PoseVector reference = PoseVector::Zero();
    for (const EeStep& s : steps) reference += (at(t) >= s.at) * s.by;
    pose += 1e-2 / 0.2 * (reference - pose);
    TruthFrame truth;
    truth.time = at(t);
    truth.p_WE = pose.head<3>();
    const Eigen::Quaterniond q(rotationFromYawPitchRoll(pose[3], pose[4], pose[5]));
    truth.quat_WE << q.w(), q.x(), q.y(), q.z();
    metrics.add(truth, reference);
  }
  return metrics.values();
}

TEST(EeStepMetrics, TurnsOfTheReferenceBeyondHalfATurnAreNoErrors) {
  const auto values = followed({stepOf(1, 3, M_PI), stepOf(5, 3, M_PI)}, 10);
  EXPECT_LT(values.at("ee_angle_error_rad"), 1e-6);
  EXPECT_NEAR(values.at("ee_yaw_rise_s"), 0.2 * std::log(10), 0.03);
  EXPECT_LT(values.at("ee_yaw_overshoot_percent"), 0.1);
  EXPECT_TRUE(followed({stepOf(1, 3, 2 * M_PI)}, 10).empty())
      << "a whole turn is no step of a pose";
}

TEST(EeStepMetrics, PitchMayGoBeyondARightAngle) {
  const auto values = followed({stepOf(1, 4, 1.0), stepOf(5, 4, 1.0)}, 10);
  EXPECT_LT(values.at("ee_angle_error_rad"), 1e-6);
  EXPECT_NEAR(values.at("ee_pitch_rise_s"), 0.2 * std::log(10), 0.03);
  EXPECT_LT(values.at("ee_pitch_overshoot_percent"), 0.1);
}

TEST(EeStepMetrics, StepsOfTwoTasksAtOneTimeAreBothJudged) {
  const auto values = followed({stepOf(1, 0, 0.3), stepOf(1, 4, 0.5)}, 10);
  EXPECT_NEAR(values.at("ee_x_rise_s"), 0.2 * std::log(10), 0.03);
  EXPECT_NEAR(values.at("ee_pitch_rise_s"), 0.2 * std::log(10), 0.03);
}

TEST(EeStepMetrics, AStepThatNobodySawIsNotMeasured) {
  EXPECT_TRUE(followed({stepOf(5, 0, 0.3)}, 4).empty()) << "it would have come later";
  EXPECT_TRUE(followed({stepOf(1, 0, 0.3)}, 4, 6).empty()) << "the stand held the robot";
}

}  // namespace
}  // namespace ballbot
