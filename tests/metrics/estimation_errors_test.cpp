#include "metrics/estimation_errors.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "metrics/home_frame.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

SimTime seconds(double s) {
  return simTimeFromNs(static_cast<std::int64_t>(std::llround(1e9 * s)));
}

TruthFrame rolling(double t) {
  TruthFrame truth;
  truth.time = seconds(t);
  truth.state[kBallX] = 3 + 0.5 * t;
  truth.state[kBallY] = -1;
  truth.state[kYaw] = 0.7;
  truth.state[kPositionDim + kBallVx] = 0.5;
  return truth;
}

TEST(EstimationErrors, AreNoneWhereTheTruthIsSeenFromTheEstimatorsOwnHome) {
  EstimationErrors errors(seconds(1));
  HomeFrame home;
  home.p_WH << 3.5, -1;
  home.yaw = 0.7;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.01 * i;
    StateEstimate estimate;
    estimate.time = seconds(t);
    const double covered = std::max(0.0, 0.5 * (t - 1));
    // What a perfect estimator says, whose x axis is the robot's own at the release.
    estimate.x[kBallX] = covered * std::cos(0.7);
    estimate.x[kBallY] = -covered * std::sin(0.7);
    estimate.x[kPositionDim + kBallVx] = 0.5 * std::cos(0.7);
    estimate.x[kPositionDim + kBallVy] = -0.5 * std::sin(0.7);
    errors.add(home.see(rolling(t)), estimate.x);
  }
  const auto values = errors.values();
  EXPECT_NEAR(values.at("position_drift_percent"), 0, 1e-9);
  EXPECT_NEAR(values.at("velocity_rms_m_per_s"), 0, 1e-12);
  EXPECT_NEAR(values.at("yaw_error_deg"), 0, 1e-9);
  EXPECT_NEAR(values.at("tilt_rms_deg"), 0, 1e-9);
  EXPECT_EQ(values.count("nees_mean"), 0u);
}

TEST(EstimationErrors, AreWhatTheyAreCalled) {
  EstimationErrors errors(seconds(0));
  for (int i = 0; i <= 200; ++i) {
    TruthFrame truth = rolling(0.01 * i);
    truth.state[kPitch] = 2 * kRadPerDeg;
    StateEstimate estimate;
    estimate.x = truth.state;
    estimate.x[kBallY] += 0.02;
    estimate.x[kYaw] += 2 * std::acos(-1.0) - 3 * kRadPerDeg;
    estimate.x[kPitch] = (i < 100 ? 1 : 2) * kRadPerDeg;
    estimate.x[kPositionDim + kBallVx] += 3e-3;
    estimate.x[kPositionDim + kBallVy] += 4e-3;
    errors.add(truth, estimate.x);
  }
  const auto values = errors.values();
  EXPECT_NEAR(values.at("position_error_m"), 0.02, 1e-12);
  EXPECT_NEAR(values.at("position_drift_percent"), 2.0, 1e-9);  // of a metre
  EXPECT_NEAR(values.at("yaw_error_deg"), 3, 1e-9);
  EXPECT_NEAR(values.at("velocity_rms_m_per_s"), 5e-3, 1e-12);
  EXPECT_NEAR(values.at("tilt_rms_deg"), std::sqrt(0.5), 0.01);
  EXPECT_NEAR(values.at("largest_tilt_error_deg"), 1, 1e-6);
}

TEST(EstimationErrors, HaveNothingToSayWithoutData) {
  EXPECT_TRUE(EstimationErrors(seconds(1)).values().empty());
}

TEST(EstimationErrors, NeesAndNisOfAMatchedFilterAreAsExpected) {
  FilterRun run;
  run.noise = whiteNoise();
  run.settings = matchedSettings();
  EstimationErrors errors(seconds(run.script.rest_s));
  run.observe = [&](const TwoStateFilter& filter, const Truth& t) {
    TruthFrame truth;
    truth.time = filter.stateTime();
    truth.state.segment<2>(kBallX) = t.motion.p_WK.head<2>();
    truth.state.segment<3>(kYaw) = t.motion.yaw_pitch_roll;
    truth.state.segment<2>(kPositionDim) = t.motion.v_WK_W.head<2>();
    errors.add(truth, filter.estimate(truth.time).x);
    errors.addConsistency(*filter.selfAssessment());
  };
  const RunErrors e = play(run);
  const auto values = errors.values();
  // The run's own errors weigh all samples alike; the metric gives the first, at which it begins,
  // no duration.
  EXPECT_NEAR(values.at("tilt_rms_deg"), e.tilt_rms_deg, 5e-3 * e.tilt_rms_deg);
  EXPECT_NEAR(values.at("velocity_rms_m_per_s"), e.velocity_rms, 5e-3 * e.velocity_rms);
  EXPECT_NEAR(values.at("nis_mean"), 4, 0.1);
  EXPECT_EQ(values.at("nis_degrees_mean"), 4);
  // One run's mean of a chi-square (4), correlated over seconds.
  EXPECT_GT(values.at("nees_mean"), 2);
  EXPECT_LT(values.at("nees_mean"), 7);
}

}  // namespace
}  // namespace ballbot::test
