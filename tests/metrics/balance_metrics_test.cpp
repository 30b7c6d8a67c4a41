#include "metrics/balance_metrics.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace ballbot {
namespace {

TruthFrame at(double t, double px, double pitch) {
  TruthFrame truth;
  truth.time = kSimStart + durationFromSeconds(t);
  truth.state[kBallX] = px;
  truth.state[kPitch] = pitch;
  return truth;
}

TEST(BalanceMetrics, MeasuresASineAsItsAmplitudeAndItsRms) {
  BalanceMetrics metrics(kSimStart);
  const double amplitude = 0.2;
  for (int k = 0; k <= 10000; ++k) {
    const double t = 1e-3 * k;  // five whole periods
    metrics.add(at(t, amplitude * std::sin(kPi * t), 0.1 * std::sin(kPi * t)), {});
  }
  const auto values = metrics.values();
  EXPECT_NEAR(values.at("largest_ball_excursion_m"), amplitude, 1e-6);
  EXPECT_NEAR(values.at("rms_ball_excursion_m"), amplitude / std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(values.at("largest_tilt_deg"), 0.1 * 180 / kPi, 1e-4);
  EXPECT_NEAR(values.at("final_ball_position_error_m"), 0, 1e-6);
}

TEST(BalanceMetrics, CountsFromTheRelease) {
  BalanceMetrics metrics(kSimStart + std::chrono::seconds(1));
  metrics.add(at(0.5, 0, 0.5), {});
  EXPECT_EQ(metrics.values().count("largest_tilt_deg"), 0u)
      << "nothing is known before the release";
  metrics.add(at(1, 3, 0.1), {});  // home is where it was released
  metrics.add(at(2, 3.25, 0.1), {});
  EXPECT_NEAR(metrics.values().at("final_ball_position_error_m"), 0.25, 1e-12);
  EXPECT_NEAR(metrics.values().at("largest_tilt_deg"), 0.1 * 180 / kPi, 1e-9);
}

TEST(BalanceMetrics, TiltIsTheAngleBetweenTheAxes) {
  StateVector x = StateVector::Zero();
  x[kYaw] = 2;
  x[kPitch] = 0.3;
  EXPECT_NEAR(tiltAngle(x), 0.3, 1e-12);
  x[kRoll] = -0.4;
  EXPECT_NEAR(std::cos(tiltAngle(x)), std::cos(0.3) * std::cos(0.4), 1e-12);
}

TEST(BalanceMetrics, AFallIsAFallAlsoWhenNumbersAreLost) {
  BalanceMetrics tipped(kSimStart), lost(kSimStart);
  tipped.add(at(0, 0, 0), {});
  tipped.add(at(3, 0, 0.79), {});
  EXPECT_TRUE(tipped.fell());
  EXPECT_NEAR(tipped.values().at("time_of_fall_s"), 3, 1e-9);
  lost.add(at(0, 0, std::nan("")), {});
  EXPECT_TRUE(lost.fell());
}

TEST(BalanceMetrics, WhoSawNothingDoesNotSayThatNothingFell) {
  EXPECT_TRUE(BalanceMetrics(kSimStart).values().empty());
}

TEST(BalanceMetrics, NamesCoverAllValues) {
  BalanceMetrics metrics(kSimStart);
  metrics.add(at(0, 0, 0), {});
  metrics.add(at(1, 0, 1), {});
  const auto names = BalanceMetrics::names();
  EXPECT_EQ(metrics.values().size(), names.size());
  for (const auto& value : metrics.values()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), value.first), 1) << value.first;
  }
}

}  // namespace
}  // namespace ballbot
