// A ball that spins about the vertical, and a filter that knows it may.
#include <cmath>

#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

constexpr double kFrom_s = 5;

SpinFilterRun runWithSpin(double rate, double lasting_s, double ramp_s) {
  SpinFilterRun run;
  run.seconds = kFrom_s + lasting_s + 2;
  run.script.spins = {{kFrom_s, kFrom_s + lasting_s, rate, ramp_s}};
  return run;
}

std::int64_t ofWheels(const RejectionCounts& counts) {
  std::int64_t sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (const Rejection r :
         {Rejection::kWheel1Outlier, Rejection::kWheel1Slip, Rejection::kWheel1Stuck}) {
      sum += counts[static_cast<Rejection>(static_cast<int>(r) + i)];
    }
  }
  return sum;
}

struct SpinCase {
  double rate, lasting_s, ramp_s;
};

class SpinTest : public testing::TestWithParam<SpinCase> {};

TEST_P(SpinTest, IsNoReasonToDoubtTheTilt) {
  const auto [rate, lasting_s, ramp_s] = GetParam();
  for (const std::uint64_t seed : {1, 2, 3}) {
    SpinFilterRun run = runWithSpin(rate, lasting_s, ramp_s);
    run.seed = seed;
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
    EXPECT_EQ(ofWheels(counts), 0);
    EXPECT_LT(e.tilt_max_deg, 0.3);
    EXPECT_LT(e.velocity_max, 0.02);
    EXPECT_LT(e.position_end, 0.01 * e.distance);
    EXPECT_LT(e.yaw_end_deg, 0.7);
  }
}

TEST_P(SpinTest, IsFoundWithinItsUncertainty) {
  const auto [rate, lasting_s, ramp_s] = GetParam();
  SpinFilterRun run = runWithSpin(rate, lasting_s, ramp_s);
  double error2 = 0, sigma2 = 0, mean = 0;
  int n = 0;
  run.observe = [&](const SpinTwoStateFilter& f, const Truth& t) {
    if (t.t_s < kFrom_s + ramp_s + 0.1 || t.t_s > kFrom_s + lasting_s) return;
    const StateEstimate e = f.estimate(f.stateTime());
    error2 += std::pow(e.spin_rate - t.mean_spin, 2);
    sigma2 += std::pow(e.spin_rate_sigma, 2);
    mean += e.spin_rate;
    ++n;
  };
  play(run);
  EXPECT_NEAR(mean / n, rate, 0.012);
  EXPECT_GT(sigma2, 0);
  EXPECT_LT(error2 / sigma2, 3);
}

INSTANTIATE_TEST_SUITE_P(OnsetsAndRates, SpinTest,
                         testing::Values(SpinCase{0.03, 2, 0}, SpinCase{0.03, 0.5, 0.05},
                                         SpinCase{0.3, 0.5, 0}, SpinCase{0.3, 2, 0.02},
                                         SpinCase{2, 0.5, 0}, SpinCase{2, 1, 0.06},
                                         SpinCase{-2, 2, 0.06}));

TEST(SpinOff, TheSameSpinThrowsTheTiltAway) {
  // What the spin filter is for: without, the wheels' disagreement is held against the state.
  FilterRun run;
  run.seconds = 8;
  run.script.spins = {{kFrom_s, kFrom_s + 1, 2, 0.06}};
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_GT(counts[Rejection::kStateDoubted], 0);
  EXPECT_GT(e.velocity_max, 0.05);
}

/// Of the gyroscope's bias about the vertical, while a robot stands on a ball that spins at `rate`.
struct BiasSeen {
  double sigma_begin = 0, sigma_end = 0, moved = 0;  ///< [rad/s]
};

constexpr double kWatch_s = 90;

BiasSeen watchBias(double rate) {
  SpinFilterRun run;
  run.script = standingStill();
  run.script.rest_s = 0.02;  // too short to know the bias from
  run.script.spins = {{1, 200, rate, 0.05}};
  run.noise = whiteNoise();
  run.settings = matchedSettings();
  run.from = 2;
  run.seconds = run.from + kWatch_s;
  BiasSeen seen;
  double error_begin = 0;
  run.observe = [&](const SpinTwoStateFilter& f, const Truth& t) {
    const double error = t.gyro_bias.z() - f.state().gyro_bias.z();
    seen.sigma_end = std::sqrt(f.covariance()(kTanGyroBias + 2, kTanGyroBias + 2));
    if (seen.sigma_begin == 0) seen.sigma_begin = seen.sigma_end, error_begin = error;
    seen.moved = std::abs(error - error_begin);
  };
  play(run);
  return seen;
}

TEST(Spin, TheGyroscopesBiasIsLearnedOnlyWhileTheBallSticks) {
  const BiasSeen sticking = watchBias(0), spinning = watchBias(1.0);
  EXPECT_LT(sticking.sigma_end, 0.8 * sticking.sigma_begin);
  // Nothing is learned; the bias wanders with 2e-5 rad/s/sqrt(s), and so far the truth has moved.
  const double wandered = std::sqrt(kWatch_s) * 2e-5;
  EXPECT_GT(spinning.sigma_end, spinning.sigma_begin);
  EXPECT_NEAR(spinning.sigma_end, std::hypot(spinning.sigma_begin, wandered), 1e-5);
  EXPECT_LT(spinning.moved, 4 * wandered);
}

TEST(Spin, OneWheelThatSlipsIsNoSpin) {
  for (const double slip_rad_per_s : {0.4, 3.0, 12.0}) {
    SpinFilterRun run;
    double slipped = 0;
    int spinning = 0;
    run.disturb = [&](SensorFrame& f, const Truth& t) {
      if (t.t_s > 8 && t.t_s <= 8.2) slipped += 2.5e-3 * slip_rad_per_s;
      f.joint_angle[0] += slipped;
    };
    run.observe = [&](const SpinTwoStateFilter& f, const Truth&) { spinning += f.spinning(); };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_GT(counts[Rejection::kWheel1Slip] + counts[Rejection::kWheel1Outlier], 60);
    EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
    EXPECT_EQ(spinning, 0) << slip_rad_per_s;
    EXPECT_LT(e.velocity_max, 0.02) << slip_rad_per_s;
    EXPECT_LT(e.position_end, 0.01 * e.distance) << slip_rad_per_s;
  }
}

TEST(Spin, AWheelThatSlipsOnABallThatSpinsIsFoundToo) {
  SpinFilterRun run = runWithSpin(1.5, 2, 0.05);
  double slipped = 0;
  run.disturb = [&](SensorFrame& f, const Truth& t) {
    if (t.t_s > kFrom_s + 1 && t.t_s <= kFrom_s + 1.2) slipped += 2.5e-3 * 3.0;
    f.joint_angle[0] += slipped;
  };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_GT(counts[Rejection::kWheel1Slip] + counts[Rejection::kWheel1Outlier], 60);
  EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
  EXPECT_LT(e.tilt_max_deg, 0.3);
  EXPECT_LT(e.velocity_max, 0.03);
}

TEST(Spin, AWheelThatLetsGoMayMakeTheBallSpin) {
  // The torques of the other two are no longer in balance: both begin at once.
  SpinFilterRun run = runWithSpin(1.7, 0.2, 0.06);
  double slipped = 0;
  run.disturb = [&](SensorFrame& f, const Truth& t) {
    const double since = t.t_s - kFrom_s;
    if (since > 0 && since <= 0.2) slipped += 2.5e-3 * std::min(200 * since, 12.0);
    f.joint_angle[0] += slipped;
  };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_GT(counts[Rejection::kWheel1Slip] + counts[Rejection::kWheel1Outlier], 60);
  EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
  EXPECT_LT(e.tilt_max_deg, 0.3);
  EXPECT_LT(e.velocity_max, 0.03);
}

TEST(Spin, AWrongInitialTiltIsStillDoubted) {
  for (const double error_deg : {10.0, -10.0}) {
    SpinFilterRun run;
    run.settings.initial_tilt_error << error_deg * kRadPerDeg, 0;
    double recovered_at = 0;
    run.observe = [&](const SpinTwoStateFilter& f, const Truth& t) {
      const Vector3 up = f.state().R_WB.transpose() * Vector3::UnitZ();
      const Vector3 up_true = t.motion.R_WB.transpose() * Vector3::UnitZ();
      if ((up - up_true).norm() > 2 * kRadPerDeg) recovered_at = t.t_s;
    };
    RejectionCounts counts;
    play(run, &counts);
    EXPECT_GE(counts[Rejection::kStateDoubted], 1);
    EXPECT_LT(recovered_at, 0.5 + 0.25);
  }
}

TEST(Spin, RejectsNothingAndSeesNoSpinWhereThereIsNone) {
  for (const SensorNoise& noise : {quantisedNoise(), whiteNoise()}) {
    SpinFilterRun run;
    run.seconds = 60;
    run.noise = noise;
    run.settings = matchedSettings();
    int spinning = 0, updates = 0;
    run.observe = [&](const SpinTwoStateFilter& f, const Truth&) {
      spinning += f.spinning();
      ++updates;
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_EQ(counts.total(), 0);
    EXPECT_LT(spinning, 0.01 * updates);
    EXPECT_LT(e.tilt_rms_deg, 0.1);
    EXPECT_LT(e.velocity_rms, 6e-3);
    EXPECT_LT(e.yaw_end_deg, 2);
  }
}

TEST(Spin, ContinuesBitForBitAfterRestoreAmidASpin) {
  const RobotParameters robot = estimatorTestRobot();
  MotionScript script = livelyMotion();
  script.spins = {{3, 5.2, 1, 0.05}};
  SimulatedSensors sensors(script, robot, quantisedNoise(), 5);
  SpinTwoStateFilter one(robot, {}), other(robot, {});
  for (int i = 0; i < 2000; ++i) {
    sensors.advance();
    one.update(sensors.frame(), sensors.atRest());
  }
  EXPECT_TRUE(one.spinning());
  other.restoreState(one.saveState());
  for (int i = 0; i < 500; ++i) {
    sensors.advance();
    one.update(sensors.frame(), false);
    other.update(sensors.frame(), false);
    const StateEstimate a = one.estimate(sensors.frame().time);
    const StateEstimate b = other.estimate(sensors.frame().time);
    ASSERT_EQ(a.x, b.x);
    ASSERT_EQ(a.spin_rate, b.spin_rate);
    ASSERT_EQ(a.spin_rate_sigma, b.spin_rate_sigma);
  }
  EXPECT_FALSE(one.spinning());
  EXPECT_EQ(one.saveState(), other.saveState());
}

}  // namespace
}  // namespace ballbot::test
