// The small parts around the filter: histories, rest alignment, arm sensing, delay compensation.
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "estimator/arm_sensing.hpp"
#include "estimator/delay_compensation.hpp"
#include "estimator/external_pose.hpp"
#include "estimator/information_update.hpp"
#include "estimator/initial_state.hpp"
#include "estimator/joint_history.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/smooth_motion.hpp"

namespace ballbot::test {
namespace {

SimTime ms(double t) { return simTimeFromNs(static_cast<std::int64_t>(std::llround(t * 1e6))); }

TEST(JointHistory, InterpolatesBetweenAndHoldsAtTheEnds) {
  JointHistory history;
  const JointVector ones = JointVector::Ones();
  for (int i = 0; i < 100; ++i) history.add(ms(0.4 * i), 0.4 * i * ones);
  EXPECT_NEAR(history.at(ms(39.0))[2], 39.0, 1e-12);
  EXPECT_NEAR(history.at(ms(38.8))[2], 38.8, 1e-12);
  EXPECT_NEAR(history.at(ms(50))[0], 39.6, 1e-12);
  // 64 values are kept.
  EXPECT_EQ(history.oldestTime(), ms(0.4 * 36));
  EXPECT_NEAR(history.at(ms(1))[0], 0.4 * 36, 1e-12);
}

TEST(JointHistory, ASecondValueOfOneTimeReplacesTheFirst) {
  JointHistory history;
  history.add(ms(1), JointVector::Constant(1));
  history.add(ms(2), JointVector::Constant(5));
  history.add(ms(2), JointVector::Constant(2));
  EXPECT_NEAR(history.at(ms(1.5))[0], 1.5, 1e-12);
}

TEST(ArmSensing, FollowsAStepOfTheRateWithItsTimeConstant) {
  ArmSensing arm(0.002);
  SensorFrame frame;
  frame.time = ms(0);
  arm.update(frame);
  frame.joint_velocity.tail<3>().setConstant(1.0);
  for (int i = 1; i <= 10; ++i) {
    frame.time = ms(0.4 * i);
    arm.update(frame);
  }
  StateVector x = StateVector::Zero();
  arm.writeTo(frame.time, x);
  EXPECT_NEAR(x[kPositionDim + kArmRate1 + 1], 1 - std::exp(-4.0 / 2.0), 1e-12);
}

TEST(RestAlignment, FindsTiltAndBiasAndLeavesTheRestCorrelated) {
  RestAlignment rest;
  const Matrix3 R = rotationFromYawPitchRoll(0, 0.05, -0.03);
  const Vector3 bias(0.01, -0.02, 0.04), gyro_bias(1e-3, 2e-3, -1e-3);
  const Vector3 up_B = R.transpose() * Vector3::UnitZ();
  for (int i = 0; i < 200; ++i) rest.add(9.81 * up_B + bias, gyro_bias);
  const InitialUncertainty prior;
  const FilterNoise noise;
  const InitialEstimate e = initialEstimate(rest, true, prior, noise, 2.5e-3, 9.81);
  // Along gravity the bias is seen; the tilt is off by what lies across, over g.
  EXPECT_NEAR(e.x.accel_bias.dot(up_B), bias.dot(up_B), 1e-4);
  const Vector3 tilt_error = e.x.R_WB.transpose() * Vector3::UnitZ() - up_B;
  const Vector3 across = bias - bias.dot(up_B) * up_B;
  EXPECT_LT((9.81 * tilt_error - across).norm(), 1e-3);
  EXPECT_EQ(e.x.gyro_bias, gyro_bias);

  const TangentMatrix P = inverseSpd(e.information);
  const auto sigma = [&P](int i) { return std::sqrt(P(i, i)); };
  EXPECT_NEAR(sigma(kTanAttitude), prior.accel_bias / 9.81, 0.05 * prior.accel_bias / 9.81);
  EXPECT_NEAR(sigma(kTanAccelBias), prior.accel_bias, 0.01 * prior.accel_bias);
  EXPECT_NEAR(sigma(kTanGyroBias), std::hypot(2.4e-3 / std::sqrt(200.0), 1e-4), 2e-5);
  // Tilt about y and bias along x are one unknown: what the pair adds up to is known well.
  const double pair = P(kTanAccelBias, kTanAccelBias) +
                      2 * 9.81 * P(kTanAccelBias, kTanAttitude + 1) * -1 +
                      9.81 * 9.81 * P(kTanAttitude + 1, kTanAttitude + 1);
  EXPECT_LT(std::sqrt(std::abs(pair)), 0.2 * prior.accel_bias);
}

TEST(DelayCompensation, FollowsAConstantTurnAndAConstantAcceleration) {
  FilterState x;
  x.p_WK_W << 1, 2;
  x.v_WK_W << 0.3, -0.1;
  x.R_WB = rotationFromYawPitchRoll(3.1, 0, 0);
  x.w_WB_B << 0, 0, 10;
  const StateVector y = bringForward(x, {2.0, 0.0}, 3.1, SimDuration{10'000'000});
  EXPECT_NEAR(y[kYaw], 3.2, 1e-12);  // across half a turn, not wrapped
  EXPECT_NEAR(y[kBallX], 1 + 0.003 + 0.5 * 2 * 1e-4, 1e-12);
  EXPECT_NEAR(y[kBallY], 2 - 0.001, 1e-12);
  EXPECT_NEAR(y[kPositionDim + kBallVx], 0.32, 1e-12);
}

TEST(PoseHistory, MovesAsARigidBody) {
  PoseHistory history;
  for (int i = 0; i < 50; ++i) history.add({ms(2.5 * i), {0.01 * i, 0.0}, 0.002 * i});
  EXPECT_FALSE(history.at(ms(200)));
  const PoseHistory::Entry before = *history.at(ms(61.25));
  EXPECT_NEAR(before.p_WK_W.x(), 0.245, 1e-12);
  const PoseHistory::Entry now{ms(122.5), {1.0, 1.0}, 0.098 + 0.5};
  history.moveTo(now);
  const PoseHistory::Entry moved = *history.at(ms(61.25));
  // Distance and yaw from there to here stay; the direction turns by half a radian.
  EXPECT_NEAR((now.p_WK_W - moved.p_WK_W).norm(), 0.49 - 0.245, 1e-12);
  EXPECT_NEAR(moved.yaw, before.yaw + 0.5, 1e-12);
  EXPECT_NEAR(std::atan2(1 - moved.p_WK_W.y(), 1 - moved.p_WK_W.x()), 0.5, 1e-12);
}

TEST(PoseRows, DerivativesAgreeWithDifferences) {
  FilterState x;
  x.p_WK_W << 0.7, -0.4;
  x.R_WB = rotationFromYawPitchRoll(0.6, 0.1, -0.15);
  const PoseHistory::Entry then{ms(0), {0.5, -0.6}, 0.5}, now{ms(50), x.p_WK_W, 0.6};
  const Vector3 pose(0.45, -0.63, 0.53);
  const PoseRows rows = poseRows(x, then, now, pose, {});
  // The truth differs from the estimate by d; what was covered since turns with its yaw.
  const auto y = [&](const TangentVector& d) {
    const FilterState moved = x.plus(d);
    const double yaw = yawPitchRollFromRotation(moved.R_WB)[0];
    const Eigen::Vector2d covered = now.p_WK_W - then.p_WK_W;
    const Matrix3 turn = rotationFromYawPitchRoll(yaw - 0.6, 0, 0);
    return Vector3(
        (moved.p_WK_W.x() - (turn.topLeftCorner<2, 2>() * covered).x() - pose.x()) / 0.005,
        (moved.p_WK_W.y() - (turn.topLeftCorner<2, 2>() * covered).y() - pose.y()) / 0.005,
        (yaw - (now.yaw - then.yaw) - pose.z()) / 0.01);
  };
  EXPECT_LT((rows.y - y(TangentVector::Zero())).norm(), 1e-9);
  for (int i = 0; i < kTangentDim; ++i) {
    const TangentVector d = 1e-6 * TangentVector::Unit(i);
    EXPECT_LT(((y(d) - y(-d)) / 2e-6 - rows.H.col(i)).norm(), 1e-5) << i;
  }
}

}  // namespace
}  // namespace ballbot::test
