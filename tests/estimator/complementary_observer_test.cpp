#include "estimator/complementary_observer.hpp"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/simulated_sensors.hpp"

namespace ballbot::test {
namespace {

struct Errors {
  double tilt_rms_deg = 0, velocity_rms = 0, position = 0, yaw_deg = 0;
};

/// Runs for `seconds` and compares with the truth at every IMU tick after the release.
Errors run(const MotionScript& script, const SensorNoise& noise, double seconds,
           const std::function<void(SensorFrame&)>& disturb = {},
           const ComplementarySettings& settings = {}) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(script, robot, noise, 7);
  ComplementaryObserver observer(robot, settings);
  double tilt2 = 0, velocity2 = 0;
  int count = 0;
  Errors e;
  while (sensors.truth().t_s < seconds) {
    sensors.advance();
    SensorFrame frame = sensors.frame();
    if (disturb) disturb(frame);
    observer.update(frame, sensors.atRest());
    if (sensors.atRest()) continue;
    const MotionSample& m = sensors.truth().motion;
    const StateVector x = observer.estimate(frame.time).x;
    const Matrix3 R = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
    const Vector3 up_error = (R.transpose() - m.R_WB.transpose()) * Vector3::UnitZ();
    const Eigen::Vector2d v_error = x.segment<2>(kPositionDim) - m.v_WK_W.head<2>();
    tilt2 += up_error.squaredNorm();
    velocity2 += v_error.squaredNorm();
    ++count;
    e.position = (x.head<2>() - m.p_WK.head<2>()).norm();
    e.yaw_deg = std::abs(x[kYaw] - m.yaw_pitch_roll[0]) / kRadPerDeg;
  }
  e.tilt_rms_deg = std::sqrt(tilt2 / count) / kRadPerDeg;
  e.velocity_rms = std::sqrt(velocity2 / count);
  return e;
}

TEST(ComplementaryObserver, FollowsAMotionWithPerfectSensors) {
  const Errors e = run(livelyMotion(), noNoise(), 20);
  EXPECT_LT(e.tilt_rms_deg, 0.02);
  EXPECT_LT(e.velocity_rms, 2e-3);
  EXPECT_LT(e.position, 2e-3);
  EXPECT_LT(e.yaw_deg, 0.1);
}

TEST(ComplementaryObserver, IsGoodEnoughToBalanceOnWithNoiseAndBias) {
  const Errors e = run(livelyMotion(), quantisedNoise(), 60);
  // Horizontal accelerometer bias of 0.03 m/s^2 alone is 0.17 degrees per axis.
  EXPECT_LT(e.tilt_rms_deg, 0.5);
  EXPECT_LT(e.velocity_rms, 0.012);
  EXPECT_LT(e.position, 0.3);
  EXPECT_LT(e.yaw_deg, 5);
}

TEST(ComplementaryObserver, AlignsTiltAndGyroBiasAtRest) {
  const RobotParameters robot = estimatorTestRobot();
  SensorNoise noise = noNoise();
  noise.gyro_bias_sigma = 3e-3;
  MotionScript script = standingStill();
  script.rest_yaw_pitch_roll << 0, 3 * kRadPerDeg, -2 * kRadPerDeg;
  SimulatedSensors sensors(script, robot, noise, 3);
  ComplementaryObserver observer(robot, {});
  EXPECT_FALSE(observer.estimate(kSimStart).aligned);
  for (int i = 0; i < 60; ++i) {
    sensors.advance();
    observer.update(sensors.frame(), true);
  }
  const StateEstimate at_rest = observer.estimate(sensors.frame().time);
  EXPECT_TRUE(at_rest.aligned);
  EXPECT_NEAR(at_rest.x[kPitch], 3 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(at_rest.x[kRoll], -2 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(at_rest.x[kYaw], 0, 1e-15);
  sensors.advance();
  observer.update(sensors.frame(), false);
  EXPECT_LT(observer.estimate(sensors.frame().time).x.segment<3>(kPositionDim + kOmegaX).norm(),
            1e-12);
}

TEST(ComplementaryObserver, NoSpinFindsTheYawRateBiasThatGravityCannotShow) {
  // The gyro's bias appears only after the alignment.
  const auto add_bias = [](SensorFrame& frame) {
    if (toSeconds(frame.time) > 1.0) frame.gyro_WB_B.z() += 0.02;
  };
  const Errors e = run(standingStill(), noNoise(), 300, add_bias);
  // It is learned with 60 s: the yaw error ends at 0.02 * 60 rad; without, it would be 12 rad.
  EXPECT_NEAR(e.yaw_deg * kRadPerDeg, 1.2, 0.05);
}

TEST(ComplementaryObserver, TakesASpinningBallForABiasWithoutALimit) {
  MotionScript script = standingStill();
  script.spins = {{2, 22, 1, 0.05}};
  ComplementarySettings unlimited;
  unlimited.spin_limit_rad_per_s = 1e6;
  const Errors blind = run(script, noNoise(), 22, {}, unlimited);
  const Errors gated = run(script, noNoise(), 22);
  // 1 rad/s learned with 60 s for 20 s: yaw goes wrong by about 20^2 / (2 * 60) rad.
  EXPECT_GT(blind.yaw_deg, 100);
  EXPECT_LT(gated.yaw_deg, 0.2);
  // Below the limit a bias is learned as ever.
  const auto add_bias = [](SensorFrame& frame) {
    if (toSeconds(frame.time) > 1.0) frame.gyro_WB_B.z() += 0.02;
  };
  const Errors biased = run(standingStill(), noNoise(), 300, add_bias);
  EXPECT_NEAR(biased.yaw_deg * kRadPerDeg, 1.2, 0.05);
}

TEST(ComplementaryObserver, YawIsContinuousAcrossHalfTurns) {
  MotionScript script = standingStill();
  script.harmonics[2] = {{5.0, 0.05, 0.0}};  // turns by 5 rad either way
  const Errors e = run(script, noNoise(), 20);
  EXPECT_LT(e.yaw_deg, 0.2);
}

TEST(ComplementaryObserver, RunsOnThroughAnImuGapAndBadValues) {
  const auto spoil = [](SensorFrame& frame) {
    const double t = toSeconds(frame.time);
    if (t > 5 && t < 5.02) frame.imu_count = 2000;
    if (t > 8 && t < 8.01) frame.gyro_WB_B.x() = std::nan("");
    if (t > 9 && t < 9.01) frame.joint_angle[1] = std::nan("");
  };
  const Errors e = run(livelyMotion(), noNoise(), 20, spoil);
  EXPECT_LT(e.tilt_rms_deg, 0.5);
  EXPECT_LT(e.velocity_rms, 0.02);
}

TEST(ComplementaryObserver, BringsTheEstimateForwardAndReadsTheArm) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 1);
  ComplementaryObserver observer(robot, {});
  while (sensors.truth().t_s < 6) {
    sensors.advance();
    SensorFrame frame = sensors.frame();
    frame.joint_angle.tail<3>() << 0.1, 0.2, 0.3;
    frame.joint_velocity.tail<3>() << 1, 0, -1;
    observer.update(frame, sensors.atRest());
  }
  const SimTime later = sensors.frame().time + SimDuration{2'000'000};
  const StateVector x = observer.estimate(later).x;
  const MotionSample m = sampleMotion(livelyMotion(), robot, toSeconds(later));
  EXPECT_LT((x.head<2>() - m.p_WK.head<2>()).norm(), 1e-3);
  EXPECT_NEAR(x[kPitch], m.yaw_pitch_roll[1], 5e-4);
  EXPECT_NEAR(x[kArm1], 0.102, 1e-9);
  EXPECT_NEAR(x[kArm1 + 2], 0.298, 1e-9);
  EXPECT_NEAR(x[kPositionDim + kArmRate1 + 2], -1, 1e-9);
}

TEST(ComplementaryObserver, ContinuesBitForBitAfterRestore) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, quantisedNoise(), 5);
  ComplementaryObserver one(robot, {}), other(robot, {});
  for (int i = 0; i < 2000; ++i) {
    sensors.advance();
    one.update(sensors.frame(), sensors.atRest());
  }
  other.restoreState(one.saveState());
  for (int i = 0; i < 500; ++i) {
    sensors.advance();
    one.update(sensors.frame(), false);
    other.update(sensors.frame(), false);
  }
  EXPECT_EQ(one.estimate(sensors.frame().time).x, other.estimate(sensors.frame().time).x);
  EXPECT_EQ(one.saveState(), other.saveState());
}

TEST(ComplementaryObserver, RefusesADamagedBlobAndKeepsItsState) {
  const RobotParameters robot = estimatorTestRobot();
  ComplementaryObserver observer(robot, {});
  const StateBlob before = observer.saveState();
  StateBlob damaged = before;
  damaged.back() ^= 1;
  EXPECT_THROW(observer.restoreState(damaged), InputError);
  EXPECT_EQ(observer.saveState(), before);
}

}  // namespace
}  // namespace ballbot::test
