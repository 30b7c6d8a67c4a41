#include "metrics/tracking_metrics.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "metrics/limit_margins.hpp"

namespace ballbot {
namespace {

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

PlaceReference asking(bool ball, bool ee) {
  PlaceReference r;
  r.ball_asked.setConstant(ball);
  r.ee_asked.setConstant(ee);
  return r;
}

TEST(TrackingMetrics, OfASineAboutItsReferenceIsItsAmplitudeOverRootTwo) {
  TrackingMetrics metrics(at(0));
  for (int i = 0; i <= 10000; ++i) {
    TruthFrame truth;
    truth.time = at(1e-3 * i);
    PlaceReference reference = asking(true, false);
    reference.ball << 3, 1;
    truth.state[kBallX] = 3 + 0.2 * std::sin(2 * M_PI * 1e-3 * i);
    truth.state[kBallY] = 1;
    metrics.add(truth, reference);
  }
  EXPECT_NEAR(metrics.values().at("rms_ball_tracking_error_m"), 0.2 / std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(metrics.values().at("largest_ball_tracking_error_m"), 0.2, 1e-6);
  EXPECT_EQ(metrics.values().count("rms_ee_tracking_error_m"), 0u);
}

TEST(TrackingMetrics, CountsOnlyComponentsThatAreAskedFor) {
  TrackingMetrics metrics(at(0));
  PlaceReference reference;
  reference.ee_asked << 1, 1, 0;
  TruthFrame truth;
  truth.p_WE << 0.03, 0.04, 5;
  metrics.add(truth, reference);
  EXPECT_NEAR(metrics.values().at("largest_ee_tracking_error_m"), 0.05, 1e-12);
}

TEST(TrackingMetrics, SaysNothingBeforeTheReleaseOrWhereNothingIsAsked) {
  TrackingMetrics metrics(at(1));
  TruthFrame truth;
  truth.state[kBallX] = 1;
  metrics.add(truth, asking(true, true));  // held in the stand
  truth.time = at(2);
  metrics.add(truth, asking(false, false));
  EXPECT_TRUE(metrics.values().empty());
}

RobotLimits limits() {
  RobotLimits l;
  l.wheel_torque = 4;
  l.arm_torque = 18;
  l.arm_lower << -3, -2, 0;
  l.arm_upper << 3, 2, 2.6;
  l.arm_rate = 6;
  l.tilt = 0.45;
  return l;
}

TEST(LimitMargins, AreTheSmallestDistancesToEachLimit) {
  LimitMargins margins(limits(), at(0));
  TruthFrame truth;
  truth.state[kArm1 + 2] = 0.25;
  truth.state[kPitch] = 0.1;
  truth.state[kPositionDim + kArmRate1] = -5;
  ActuatorCommand command;
  command.torque << 1, -3.5, 0, 2, 0, -17;
  margins.add(truth, command);
  truth.time = at(1);
  truth.state.setZero();
  truth.state[kArm1 + 2] = 1;
  margins.add(truth, ActuatorCommand{});  // easier: does not make a margin larger
  const auto m = margins.values();
  EXPECT_NEAR(m.at("least_wheel_torque_margin_Nm"), 0.5, 1e-12);
  EXPECT_NEAR(m.at("least_arm_torque_margin_Nm"), 1, 1e-12);
  EXPECT_NEAR(m.at("least_arm_position_margin_rad"), 0.25, 1e-12);
  EXPECT_NEAR(m.at("least_arm_rate_margin_rad_per_s"), 1, 1e-12);
  EXPECT_NEAR(m.at("least_tilt_margin_deg"), 0.35 * 180 / M_PI, 1e-9);
}

TEST(LimitMargins, AreNegativeBeyondALimit) {
  LimitMargins margins(limits(), at(0));
  TruthFrame truth;
  truth.state[kArm1 + 1] = -2.1;
  margins.add(truth, ActuatorCommand{});
  EXPECT_NEAR(margins.values().at("least_arm_position_margin_rad"), -0.1, 1e-12);
}

}  // namespace
}  // namespace ballbot
