#include <gtest/gtest.h>

#include "estimator/complementary_observer.hpp"
#include "estimator/two_state_filter.hpp"
#include "tests/estimator/support/simulated_sensors.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot::test {
namespace {

/// Motion with everything that can happen: gaps, spikes, slip, poses, doubt.
std::int64_t allocationsOf(Estimator& estimator) {
  SimulatedSensors sensors(livelyMotion(), estimatorTestRobot(), quantisedNoise(), 3);
  std::int64_t counted = 0;
  while (sensors.truth().t_s < 6) {
    sensors.advance();
    SensorFrame f = sensors.frame();
    const double t = sensors.truth().t_s;
    if (t > 2 && t < 2.05) f.imu_count = 800;
    if (f.imu_count % 97 == 0) f.gyro_WB_B.x() += 1;
    if (t > 3 && t < 3.2) f.joint_angle.head<3>().array() += 4 * (t - 3);  // a spin
    if (t > 4 && t < 4.2) f.joint_angle.head<2>().array() += 2 * (t - 4);
    f.pose_count = f.imu_count / 4;
    f.pose_time = f.time - SimDuration{20'000'000};
    const std::int64_t before = allocationCount();
    estimator.update(f, sensors.atRest());
    const StateEstimate e = estimator.estimate(f.time + SimDuration{400'000});
    counted += allocationCount() - before;
    EXPECT_TRUE(e.x.allFinite());
  }
  return counted;
}

TEST(EstimatorMemory, UpdateAndEstimateAllocateNothing) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  const std::int64_t before = allocationCount();
  EXPECT_GT(estimatorTestRobot().name.append(100, ' ').size(), 0u);
  EXPECT_GT(allocationCount(), before);  // the counter counts
  TwoStateSettings settings;
  settings.use_external_pose = true;
  TwoStateFilter filter(estimatorTestRobot(), settings);
  EXPECT_EQ(allocationsOf(filter), 0);
  EXPECT_GT(filter.rejections()[Rejection::kStateDoubted], 0);
  EXPECT_GT(filter.rejections()[Rejection::kImuMissing], 0);
  settings.initial_tilt_error << 0.17, 0;  // two wheels that slip alike are a spin and one wheel
  SpinTwoStateFilter spin_filter(estimatorTestRobot(), settings);
  EXPECT_EQ(allocationsOf(spin_filter), 0);
  EXPECT_GT(spin_filter.rejections()[Rejection::kStateDoubted], 0);
  ComplementaryObserver observer(estimatorTestRobot(), {});
  EXPECT_EQ(allocationsOf(observer), 0);
}

}  // namespace
}  // namespace ballbot::test
