#include "estimator/two_state_filter.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

TEST(TwoStateFilter, MeetsItsAccuracyOverAMinuteOfMotion) {
  FilterRun run;
  run.seconds = 60;
  const RunErrors e = play(run);
  EXPECT_GT(e.distance, 15);
  EXPECT_LT(e.tilt_rms_deg, 0.1);
  EXPECT_LT(e.velocity_rms, 6e-3);
  EXPECT_LT(e.position_end, 0.01 * e.distance);
  EXPECT_LT(e.yaw_end_deg, 2.0);
}

TEST(TwoStateFilter, IsExactWithPerfectSensors) {
  FilterRun run;
  run.noise = noNoise();
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  // What is left is the half interval by which the lever arm's force lags.
  EXPECT_LT(e.tilt_max_deg, 0.01);
  EXPECT_LT(e.velocity_max, 5e-4);
  EXPECT_LT(e.position_end, 1e-4);
  EXPECT_LT(e.yaw_end_deg, 0.01);
  EXPECT_EQ(counts.total(), 0);
}

TEST(TwoStateFilter, RejectsNothingWhereNothingIsWrong) {
  for (const SensorNoise& noise : {quantisedNoise(), whiteNoise()}) {
    FilterRun run;
    run.noise = noise;
    run.settings = matchedSettings();
    RejectionCounts counts;
    play(run, &counts);
    EXPECT_EQ(counts.total(), 0);
  }
}

TEST(TwoStateFilter, ReleasesAlignedAndLevelWithZeroPositionAndYaw) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(standingStill(), robot, quantisedNoise(), 2);
  TwoStateFilter filter(robot, {});
  EXPECT_FALSE(filter.estimate(kSimStart).aligned);
  while (sensors.truth().t_s < 0.3) {
    sensors.advance();
    filter.update(sensors.frame(), true);
  }
  const StateEstimate e = filter.estimate(sensors.frame().time);
  EXPECT_TRUE(e.aligned);
  EXPECT_NEAR(e.x[kBallX], 0, 1e-12);
  EXPECT_NEAR(e.x[kYaw], 0, 1e-12);
  EXPECT_NEAR(e.x[kPitch], 0.02, 4 * e.sigma[3]);
  EXPECT_NEAR(e.sigma[2], 0.03 / 9.81, 5e-4);
}

TEST(TwoStateFilter, StartsInMotionWithoutAnyRest) {
  const RobotParameters robot = estimatorTestRobot();
  MotionScript script = livelyMotion();
  script.rest_s = -10;  // in full swing from the first sample on
  SimulatedSensors sensors(script, robot, quantisedNoise(), 2);
  TwoStateFilter filter(robot, {});
  double tilt_error = 0;
  while (sensors.truth().t_s < 5) {
    sensors.advance();
    filter.update(sensors.frame(), false);
    EXPECT_FALSE(filter.estimate(sensors.frame().time).aligned);
    tilt_error = ((filter.state().R_WB.transpose() - sensors.truth().motion.R_WB.transpose()) *
                  Vector3::UnitZ())
                     .norm();
  }
  EXPECT_LT(tilt_error, 0.5 * kRadPerDeg);
}

TEST(TwoStateFilter, BridgesAnImuGapOfFiftyMilliseconds) {
  FilterRun run;
  run.disturb = [](SensorFrame& f, const Truth& t) {
    if (t.t_s > 8 && t.t_s < 8.0501) f.imu_count = 3200;
  };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_EQ(counts[Rejection::kImuMissing], 20);
  EXPECT_LT(e.tilt_max_deg, 0.5);
  EXPECT_LT(e.velocity_max, 0.03);
  EXPECT_LT(e.position_end, 0.01 * e.distance);
}

TEST(TwoStateFilter, DropsLateAndTakesDelayedImuSamples) {
  // Every sample comes 5 ms after its interval; each tenth comes 20 ms late and is worthless.
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 1);
  TwoStateFilter filter(robot, {});
  std::vector<SensorFrame> sent;
  while (sensors.truth().t_s < 9.99) {
    sensors.advance();
    SensorFrame frame = sensors.frame();
    sent.push_back(frame);
    const auto n = sent.size();
    const std::size_t age = n % 10 == 0 ? 8 : 2;
    if (n <= age) continue;
    const SensorFrame& old = sent[n - 1 - age];
    frame.imu_count = static_cast<std::int64_t>(n);
    frame.imu_time = old.imu_time;
    frame.accel_B = old.accel_B;
    frame.gyro_WB_B = old.gyro_WB_B;
    filter.update(frame, sensors.atRest());
  }
  EXPECT_NEAR(static_cast<double>(filter.rejections()[Rejection::kImuLate]), 9.5 * 40, 3);
  EXPECT_EQ(filter.stateTime(), sent.back().time - SimDuration{5'000'000});
  // The estimate of now is brought forward by 5 ms.
  const StateVector x = filter.estimate(sent.back().time).x;
  EXPECT_NEAR(x[kPitch], sensors.truth().motion.yaw_pitch_roll[1], 0.1 * kRadPerDeg);
  EXPECT_LT((x.head<2>() - sensors.truth().motion.p_WK.head<2>()).norm(), 5e-3);
}

TEST(TwoStateFilter, LearnsThePeriodOfTheImu) {
  // The same sensors, but every second frame is lost on the way: half the rate, half the noise.
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 1);
  TwoStateFilter filter(robot, {});
  std::int64_t count = 0;
  while (sensors.truth().t_s < 5) {
    sensors.advance();
    SensorFrame frame = sensors.frame();
    const SensorFrame first = frame;
    sensors.advance();
    frame = sensors.frame();
    frame.imu_count = ++count;
    frame.accel_B = 0.5 * (first.accel_B + frame.accel_B);
    frame.gyro_WB_B = 0.5 * (first.gyro_WB_B + frame.gyro_WB_B);
    filter.update(frame, sensors.atRest());
  }
  EXPECT_EQ(filter.rejections()[Rejection::kImuMissing], 0);
  EXPECT_LT((filter.state().v_WK_W - sensors.truth().motion.v_WK_W.head<2>()).norm(), 2e-3);
}

TEST(TwoStateFilter, FindsAStuckEncoder) {
  FilterRun run;
  double held = 0;
  run.disturb = [&held](SensorFrame& f, const Truth& t) {
    if (t.t_s <= 8)
      held = f.joint_angle[1];
    else
      f.joint_angle[1] = held;
  };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_GT(counts[Rejection::kWheel2Stuck], 4000);
  EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
  EXPECT_LT(e.tilt_max_deg, 0.5);
  EXPECT_LT(e.velocity_max, 0.03);
}

TEST(TwoStateFilter, PassesOverSpikesOfAHundredSigma) {
  FilterRun run;
  int gyro = 0, accel = 0, wheel = 0;
  run.disturb = [&](SensorFrame& f, const Truth& t) {
    if (t.t_s < 5) return;
    if (f.imu_count % 97 == 0) f.gyro_WB_B += 0.24 * Vector3(0.6, -0.48, 0.64), ++gyro;
    if (f.imu_count % 89 == 0) f.accel_B += 2.4 * Vector3(0.6, -0.48, 0.64), ++accel;
    if (f.imu_count % 83 == 0) f.joint_angle[f.imu_count % 3] += 0.0436, ++wheel;
  };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_EQ(counts[Rejection::kGyroSpike], gyro);
  EXPECT_EQ(counts[Rejection::kAccelSpike], accel);
  // A spike of an angle spoils the increments before and after.
  EXPECT_EQ(counts[Rejection::kWheel1Outlier] + counts[Rejection::kWheel2Outlier] +
                counts[Rejection::kWheel3Outlier],
            2 * wheel);
  EXPECT_LT(e.tilt_max_deg, 0.4);
  EXPECT_LT(e.velocity_rms, 3e-3);
}

TEST(TwoStateFilter, AlignsOnARestWithSpikes) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(standingStill(), robot, whiteNoise(), 4);
  TwoStateFilter filter(robot, {});
  int spikes = 0;
  while (sensors.truth().t_s < 0.45) {
    sensors.advance();
    SensorFrame f = sensors.frame();
    if (f.imu_count % 20 == 0) f.gyro_WB_B.y() += 0.24, f.accel_B.x() -= 2.4, ++spikes;
    filter.update(f, true);
  }
  EXPECT_EQ(filter.rejections()[Rejection::kGyroSpike], spikes);
  EXPECT_EQ(filter.rejections()[Rejection::kAccelSpike], spikes);
  // Noise of 2.4e-3 rad/s averaged over 171 samples, four sigma; the spikes' mean would be 0.012.
  EXPECT_LT((filter.state().gyro_bias - sensors.truth().gyro_bias).cwiseAbs().maxCoeff(), 8e-4);
}

TEST(TwoStateFilter, ToleratesAWheelThatSlips) {
  for (const double slip_rad_per_s : {0.4, 3.0, 12.0}) {
    FilterRun run;
    double slipped = 0;
    run.disturb = [&](SensorFrame& f, const Truth& t) {
      if (t.t_s > 8 && t.t_s <= 8.2) slipped += 2.5e-3 * slip_rad_per_s;
      f.joint_angle[0] += slipped;
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_GT(counts[Rejection::kWheel1Slip] + counts[Rejection::kWheel1Outlier], 60);
    EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
    EXPECT_LT(e.velocity_max, 0.02) << slip_rad_per_s;
    EXPECT_LT(e.position_end, 0.01 * e.distance) << slip_rad_per_s;
  }
}

TEST(TwoStateFilter, RecoversFromAWrongInitialTilt) {
  for (const double error_deg : {10.0, -10.0}) {
    FilterRun run;
    run.settings.initial_tilt_error << error_deg * kRadPerDeg, 0;
    double recovered_at = 0;
    run.observe = [&](const TwoStateFilter& f, const Truth& t) {
      const Vector3 up = f.state().R_WB.transpose() * Vector3::UnitZ();
      const Vector3 up_true = t.motion.R_WB.transpose() * Vector3::UnitZ();
      if ((up - up_true).norm() > 2 * kRadPerDeg) recovered_at = t.t_s;
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_GT(e.tilt_max_deg, 9.5);
    EXPECT_EQ(counts[Rejection::kStateDoubted], 1);
    EXPECT_LT(recovered_at, 0.5 + 0.15);
    EXPECT_LT(e.position_end, 0.01 * e.distance);
  }
}

TEST(TwoStateFilter, ExternalPoseBoundsTheDrift) {
  FilterRun run;
  run.seconds = 40;
  run.settings.use_external_pose = true;
  const RandomStream noise(9, "mocap");
  std::vector<std::pair<SimTime, Vector3>> poses;
  run.disturb = [&](SensorFrame& f, const Truth& t) {
    const auto n = noise.normals(static_cast<std::uint64_t>(f.imu_count));
    poses.emplace_back(f.time,
                       Vector3(t.motion.p_WK.x() + 0.005 * n[0], t.motion.p_WK.y() + 0.005 * n[1],
                               t.motion.yaw_pitch_roll[0] + 0.01 * n[2]));
    // 100 Hz, 40 ms old, with a gross error now and then.
    const auto sample = static_cast<std::size_t>(f.imu_count) / 4 * 4;
    if (sample < 20) return;
    f.pose_count = static_cast<std::int64_t>(sample / 4);
    f.pose_time = poses[sample - 17].first;
    f.pose_W = poses[sample - 17].second;
    if (f.pose_count % 50 == 0) f.pose_W.x() += 1.0;
  };
  RejectionCounts counts;
  double yaw2 = 0, position2 = 0;
  int n = 0;
  run.observe = [&](const TwoStateFilter& f, const Truth& t) {
    if (t.t_s < 10) return;
    const TangentVector e = truthAsFilterState(t).minus(f.state());
    yaw2 += std::pow((t.motion.R_WB * e.segment<3>(kTanAttitude)).z(), 2);
    position2 += e.segment<2>(kTanPosition).squaredNorm();
    ++n;
  };
  play(run, &counts);
  EXPECT_NEAR(static_cast<double>(counts[Rejection::kPoseOutlier]), 40 * 100 / 50, 4);
  // The first ones are from before the release.
  EXPECT_LE(counts[Rejection::kPoseLate], 4);
  EXPECT_LT(std::sqrt(yaw2 / n), 0.2 * kRadPerDeg);
  EXPECT_LT(std::sqrt(position2 / n), 2e-3);
}

TEST(TwoStateFilter, ComesOverToAPoseThatInsists) {
  FilterRun run;
  run.script = standingStill();
  run.seconds = 3;
  run.settings.use_external_pose = true;
  run.disturb = [](SensorFrame& f, const Truth& t) {
    if (t.t_s < 1 || f.imu_count % 4 != 0) return;
    f.pose_count = f.imu_count;
    f.pose_time = f.time;
    f.pose_W << 2.0, -1.0, 1.0;
  };
  Vector3 estimate = Vector3::Zero();
  run.observe = [&](const TwoStateFilter& f, const Truth& t) {
    const StateVector x = f.estimate(f.stateTime()).x;
    if (t.t_s > 2.99) estimate << x[kBallX], x[kBallY], x[kYaw];
  };
  play(run);
  EXPECT_LT((estimate - Vector3(2.0, -1.0, 1.0)).norm(), 0.01);
}

TEST(TwoStateFilter, CountsFramesThatAreLateOrNotFinite) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(standingStill(), robot, noNoise(), 1);
  TwoStateFilter filter(robot, {});
  SensorFrame before;
  for (int i = 0; i < 300; ++i) {
    before = sensors.frame();
    sensors.advance();
    filter.update(sensors.frame(), sensors.atRest());
  }
  filter.update(before, false);
  EXPECT_EQ(filter.rejections()[Rejection::kFrameLate], 1);
  sensors.advance();
  SensorFrame bad = sensors.frame();
  bad.gyro_WB_B.y() = std::nan("");
  bad.joint_angle[4] = INFINITY;
  filter.update(bad, false);
  EXPECT_EQ(filter.rejections()[Rejection::kNotFinite], 2);
  for (int i = 0; i < 50; ++i) {
    sensors.advance();
    filter.update(sensors.frame(), false);
  }
  EXPECT_LT(filter.state().v_WK_W.norm(), 1e-4);
}

TEST(TwoStateFilter, SigmaIsTheCovarianceSeenFromTheWorld) {
  FilterRun run;
  run.seconds = 5;
  run.script.rest_yaw_pitch_roll << 0, 0.3, -0.2;
  Eigen::Matrix<double, 10, 1> sigma;
  TangentMatrix P;
  Matrix3 R;
  run.observe = [&](const TwoStateFilter& f, const Truth&) {
    sigma = f.estimate(f.stateTime()).sigma;
    P = f.covariance();
    R = f.state().R_WB;
  };
  play(run);
  EXPECT_NEAR(sigma[1] * sigma[1], P(1, 1), 1e-9 * P(1, 1));
  const Matrix3 P_W = R * P.block<3, 3>(kTanAttitude, kTanAttitude) * R.transpose();
  EXPECT_NEAR(sigma[4] * sigma[4], P_W(2, 2), 1e-6 * P_W(2, 2));
  EXPECT_NEAR(sigma[9] * sigma[9], P(9, 9), 1e-9 * P(9, 9));
}

TEST(TwoStateFilter, ContinuesBitForBitAfterRestore) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, quantisedNoise(), 5);
  TwoStateSettings settings;
  settings.use_external_pose = true;
  TwoStateFilter one(robot, settings), other(robot, settings);
  const auto frame = [&] {
    SensorFrame f = sensors.frame();
    f.pose_count = f.imu_count / 10;
    f.pose_time = f.time - SimDuration{20'000'000};
    f.pose_W << sensors.truth().motion.p_WK.head<2>(), 0.0;
    if (f.imu_count % 50 == 0) f.joint_angle[0] += 0.05;
    return f;
  };
  for (int i = 0; i < 2000; ++i) {
    sensors.advance();
    one.update(frame(), sensors.atRest());
  }
  other.restoreState(one.saveState());
  for (int i = 0; i < 500; ++i) {
    sensors.advance();
    one.update(frame(), false);
    other.update(frame(), false);
    ASSERT_EQ(one.estimate(sensors.frame().time).x, other.estimate(sensors.frame().time).x);
    ASSERT_EQ(one.estimate(sensors.frame().time).sigma, other.estimate(sensors.frame().time).sigma);
  }
  EXPECT_EQ(one.saveState(), other.saveState());
}

TEST(TwoStateFilter, RefusesADamagedBlobAndKeepsItsState) {
  const RobotParameters robot = estimatorTestRobot();
  TwoStateFilter filter(robot, {});
  const StateBlob before = filter.saveState();
  StateBlob damaged = before;
  damaged[damaged.size() / 2] ^= 4;
  EXPECT_THROW(filter.restoreState(damaged), InputError);
  EXPECT_EQ(filter.saveState(), before);
}

}  // namespace
}  // namespace ballbot::test
