// Frames and samples from another time: no call may take long, and none may leave the estimator
// deaf to what follows.
#include "estimator/frame_order.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "estimator/complementary_observer.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

constexpr SimDuration kHour{3'600'000'000'000};

SimTime ms(std::int64_t t) { return simTimeFromNs(t * 1'000'000); }

TEST(FrameOrder, TakesWhatFollowsAndRefusesWhatIsLateOrFarAhead) {
  FrameOrder order;
  EXPECT_EQ(order.judge(ms(5000)), FrameTime::kNext);
  EXPECT_EQ(order.judge(ms(5000)), FrameTime::kNext);
  EXPECT_EQ(order.judge(ms(6000)), FrameTime::kNext);
  EXPECT_EQ(order.judge(ms(5999)), FrameTime::kLate);
  EXPECT_EQ(order.judge(ms(6000) + kHour), FrameTime::kAhead);
  EXPECT_EQ(order.judge(ms(6003)), FrameTime::kNext);
}

TEST(FrameOrder, BelievesAGapThatTenFramesConfirm) {
  FrameOrder order;
  order.judge(ms(0));
  for (int i = 0; i < 9; ++i) EXPECT_EQ(order.judge(ms(5000 + i)), FrameTime::kAhead);
  EXPECT_EQ(order.judge(ms(5009)), FrameTime::kLeap);
  EXPECT_EQ(order.judge(ms(5010)), FrameTime::kNext);
}

TEST(FrameOrder, ARefusedFrameLeavesNoTraceInTheEstimate) {
  for (const double at_s : {0.3, 5.0}) {  // held; in motion
    FilterRun run;
    run.seconds = 8;
    run.disturb = [&](SensorFrame& f, const Truth& t) {
      if (std::abs(t.t_s - at_s) < 1e-3) f.time += kHour, f.imu_time += kHour;
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_EQ(counts[Rejection::kFrameAhead], 1);
    EXPECT_EQ(counts[Rejection::kFrameLate], 0);
    EXPECT_LE(counts[Rejection::kImuMissing], 1);
    EXPECT_LT(e.tilt_max_deg, 0.4) << at_s;
    EXPECT_LT(e.position_end, 0.01 * e.distance) << at_s;
  }
}

TEST(FrameOrder, AnInertialSampleFromTheFutureIsMissing) {
  for (const double at_s : {0.3, 0.5, 5.0}) {
    FilterRun run;
    run.seconds = 8;
    run.disturb = [&](SensorFrame& f, const Truth& t) {
      if (std::abs(t.t_s - at_s) < 1e-3) f.imu_time += kHour;
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_EQ(counts[Rejection::kImuAhead], 1);
    EXPECT_EQ(counts[Rejection::kImuLate], 0);
    EXPECT_LT(e.tilt_max_deg, 0.4) << at_s;
  }
}

TEST(FrameOrder, ACounterThatJumpsAtRestDoesNotMakeIntervalsOfNoLength) {
  FilterRun run;
  run.seconds = 2;
  run.disturb = [](SensorFrame& f, const Truth& t) {
    if (t.t_s > 0.49) f.imu_count += 1'000'000'000'000;
  };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);  // ends at all
  EXPECT_LT(e.tilt_max_deg, 1);
}

TEST(FrameOrder, AfterARealGapTheEstimatorBeginsAnew) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, quantisedNoise(), 2);
  TwoStateFilter filter(robot, {});
  ComplementaryObserver observer(robot, {});
  while (sensors.truth().t_s < 14) {
    sensors.advance();
    const double t = sensors.truth().t_s;
    if (t > 4 && t < 9) continue;
    filter.update(sensors.frame(), sensors.atRest());
    observer.update(sensors.frame(), sensors.atRest());
  }
  EXPECT_EQ(filter.rejections()[Rejection::kFrameAhead], 9);
  EXPECT_GE(filter.rejections()[Rejection::kStateDoubted], 1);
  EXPECT_EQ(filter.stateTime(), sensors.frame().time);
  const auto tilt_error_deg = [&](const StateVector& x) {
    return std::hypot(x[kPitch] - sensors.truth().motion.yaw_pitch_roll[1],
                      x[kRoll] - sensors.truth().motion.yaw_pitch_roll[2]) /
           kRadPerDeg;
  };
  EXPECT_LT(tilt_error_deg(filter.estimate(filter.stateTime()).x), 0.3);
  EXPECT_LT(tilt_error_deg(observer.estimate(sensors.frame().time).x), 3);
}

TEST(FrameOrder, AnObserverRefusesAnHourToo) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 2);
  ComplementaryObserver clean(robot, {}), spoiled(robot, {});
  while (sensors.truth().t_s < 3) {
    sensors.advance();
    EXPECT_TRUE(clean.update(sensors.frame(), sensors.atRest()));
    EXPECT_TRUE(spoiled.update(sensors.frame(), sensors.atRest()));
    SensorFrame ahead = sensors.frame();
    ahead.time += kHour;
    EXPECT_FALSE(spoiled.update(ahead, false));
    SensorFrame imu_ahead = sensors.frame();
    imu_ahead.imu_time += kHour;
    imu_ahead.imu_count += 1000;
    EXPECT_TRUE(spoiled.update(imu_ahead, sensors.atRest()));
  }
  EXPECT_EQ(clean.estimate(sensors.frame().time).x, spoiled.estimate(sensors.frame().time).x);
}

TEST(FrameOrder, NothingIsExtrapolatedBackwards) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 2);
  TwoStateFilter filter(robot, {});
  while (sensors.truth().t_s < 3) {
    sensors.advance();
    filter.update(sensors.frame(), sensors.atRest());
  }
  EXPECT_EQ(filter.estimate(sensors.frame().time - kHour).x,
            filter.estimate(sensors.frame().time).x);
}

}  // namespace
}  // namespace ballbot::test
