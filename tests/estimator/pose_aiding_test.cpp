// Poses from outside: where the robot stands while it is held, and corrections far beyond what is
// small.
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "estimator/attitude.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

/// The world of the cameras against the one of the motion: the robot starts at (1.5, -0.8), turned.
struct OtherWorld {
  double yaw = 0;
  Eigen::Vector2d origin{1.5, -0.8};

  Eigen::Vector2d point(const Vector3& p) const {
    return origin + Eigen::Rotation2Dd(yaw) * p.head<2>();
  }
  Eigen::Vector2d direction(const Vector3& v) const {
    return Eigen::Rotation2Dd(yaw) * v.head<2>();
  }
};

/// 100 poses a second of 2 mm and 0.2 degrees noise, 30 ms old, from `from_s` on.
class Cameras {
 public:
  Cameras(const OtherWorld& world, double from_s) : world_(world), from_s_(from_s) {}

  void operator()(SensorFrame& f, const Truth& t) {
    const auto n = noise_.normals(static_cast<std::uint64_t>(f.imu_count));
    const Eigen::Vector2d p = world_.point(t.motion.p_WK) + 0.002 * Eigen::Vector2d(n[0], n[1]);
    taken_.push_back(f);
    taken_.back().pose_W << p, world_.yaw + t.motion.yaw_pitch_roll[0] + 0.0035 * n[2];
    const std::size_t latest = taken_.size() / 4 * 4;
    if (latest < 16 || t.t_s < from_s_) return;
    const SensorFrame& seen = taken_[latest - 12];
    f.pose_count = static_cast<std::int64_t>(latest);
    f.pose_time = seen.time;
    f.pose_W = seen.pose_W;
  }

 private:
  OtherWorld world_;
  double from_s_;
  RandomStream noise_{9, "cameras"};
  std::vector<SensorFrame> taken_;
};

FilterRun runWithCameras(const OtherWorld& world, double from_s) {
  FilterRun run;
  run.seconds = 6;
  run.settings.use_external_pose = true;
  run.settings.pose.position_sigma_m = 0.002;
  run.settings.pose.yaw_sigma_rad = 0.0035;
  run.disturb = Cameras(world, from_s);
  return run;
}

struct WorldErrors {
  double yaw = 0, position = 0, velocity = 0;
};

WorldErrors errorsIn(const OtherWorld& world, const TwoStateFilter& f, const Truth& t) {
  const StateVector x = f.estimate(f.stateTime()).x;
  WorldErrors e;
  e.yaw = std::abs(unwrapped(x[kYaw] - world.yaw - t.motion.yaw_pitch_roll[0], 0.0));
  e.position = (f.state().p_WK_W - world.point(t.motion.p_WK)).norm();
  e.velocity = (f.state().v_WK_W - world.direction(t.motion.v_WK_W)).norm();
  return e;
}

TEST(PoseAiding, KnowsFromTheHoldWhereTheRobotStands) {
  for (const double yaw_deg : {30.0, 90.0, 120.0, 180.0, -170.0}) {
    const OtherWorld world{yaw_deg * kRadPerDeg};
    FilterRun run = runWithCameras(world, 0);
    WorldErrors at_release, at_end;
    run.observe = [&](const TwoStateFilter& f, const Truth& t) {
      if (t.t_s < 0.5026) at_release = errorsIn(world, f, t);
      at_end = errorsIn(world, f, t);
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_LT(at_release.yaw, 0.1 * kRadPerDeg) << yaw_deg;
    EXPECT_LT(at_release.position, 1e-3) << yaw_deg;
    EXPECT_LT(e.tilt_max_deg, 0.5) << yaw_deg;
    EXPECT_LT(at_end.yaw, 0.2 * kRadPerDeg) << yaw_deg;
    EXPECT_LT(at_end.position, 4e-3) << yaw_deg;
    EXPECT_EQ(counts[Rejection::kPoseOutlier], 0) << yaw_deg;
  }
}

TEST(PoseAiding, TurnsAllTheWayAtTheFirstPoseOfAMovingRobot) {
  // The cameras begin when the robot has been under way for two seconds, and know it is turned.
  for (const double yaw_deg : {60.0, 120.0, -170.0}) {
    const OtherWorld world{yaw_deg * kRadPerDeg};
    FilterRun run = runWithCameras(world, 2.5);
    run.settings.initial.yaw = 180 * kRadPerDeg;
    run.settings.initial.position = 1;
    double worst_yaw = 0, worst_velocity = 0;
    run.observe = [&](const TwoStateFilter& f, const Truth& t) {
      if (t.t_s < 2.52) return;
      const WorldErrors e = errorsIn(world, f, t);
      worst_yaw = std::max(worst_yaw, e.yaw);
      worst_velocity = std::max(worst_velocity, e.velocity);
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_LT(e.tilt_max_deg, 0.5) << yaw_deg;
    EXPECT_LT(worst_yaw, 1.0 * kRadPerDeg) << yaw_deg;
    EXPECT_LT(worst_velocity, 0.02) << yaw_deg;
    EXPECT_EQ(counts.total(), 0) << yaw_deg;
  }
}

TEST(PoseAiding, AnUnknownHeadingDoesNotLetTheEstimateWanderBeforeTheFirstPose) {
  FilterRun run;
  run.settings.initial.yaw = 180 * kRadPerDeg;
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_EQ(counts.total(), 0);
  EXPECT_LT(e.tilt_max_deg, 0.5);
  EXPECT_LT(e.yaw_end_deg, 1.0);
}

TEST(PoseAiding, TenRefusedInARowTurnAMovingRobotWithoutTiltingIt) {
  const OtherWorld world{2.0};
  FilterRun run = runWithCameras(world, 2.5);  // sure of yaw and place, and wrong
  WorldErrors at_end;
  run.observe = [&](const TwoStateFilter& f, const Truth& t) { at_end = errorsIn(world, f, t); };
  RejectionCounts counts;
  const RunErrors e = play(run, &counts);
  EXPECT_EQ(counts[Rejection::kPoseOutlier], kPosesUntilBelieved);
  EXPECT_EQ(counts[Rejection::kStateDoubted], 0);
  EXPECT_LT(e.tilt_max_deg, 0.5);
  EXPECT_LT(at_end.yaw, 0.3 * kRadPerDeg);
  EXPECT_LT(at_end.position, 5e-3);
}

/// An information filter on what the sensors say from the release on.
class FromRelease {
 public:
  explicit FromRelease(const TwoStateSettings& settings)
      : robot_(estimatorTestRobot()),
        sensors_(livelyMotion(), robot_, quantisedNoise(), 3),
        filter_(robot_, settings.noise, settings.gate, settings.initial.accel_bias, 2) {
    TwoStateFilter held(robot_, settings);
    while (sensors_.truth().t_s < 0.4999) {
      sensors_.advance();
      held.update(sensors_.frame(), true);
    }
    filter_.initialise(held.state(), held.information());
  }

  void go(int intervals) {
    for (int i = 0; i < intervals; ++i) {
      IntervalMeasurement m;
      m.h = 2.5e-3;
      m.has_accel = m.has_gyro = true;
      m.has_wheel.fill(true);
      m.wheel_increment = -sensors_.frame().joint_angle.head<kWheelCount>();
      sensors_.advance();
      m.wheel_increment += sensors_.frame().joint_angle.head<kWheelCount>();
      m.accel_B = sensors_.frame().accel_B;
      m.gyro_B = sensors_.frame().gyro_WB_B;
      filter_.step(m, counts_);
    }
    EXPECT_EQ(counts_.total(), 0);
  }
  InformationFilter& filter() { return filter_; }

 private:
  RobotParameters robot_;
  SimulatedSensors sensors_;
  InformationFilter filter_;
  RejectionCounts counts_;
};

TEST(PoseAiding, ATurnCommutesWithWhatTheSensorsSay) {
  TwoStateSettings settings;
  settings.initial.yaw = 10 * kRadPerDeg;  // from the release on, where position is known
  const double angle = 2.5;
  FromRelease early(settings), late(settings);
  early.go(1000);
  early.filter().turn(angle);
  early.go(400);
  late.go(1400);
  late.filter().turn(angle);
  const TangentVector difference = early.filter().state().minus(late.filter().state());
  EXPECT_LT(difference.tail<14>().norm(), 1e-6);
  // Position turns about where yaw was last known, which is the place of the release but for what
  // yaw has drifted since: some centimetres, where turning about the robot would be off by metres.
  EXPECT_LT(difference.head<2>().norm(), 0.1);
  const TangentMatrix P = early.filter().covariance(), P_late = late.filter().covariance();
  EXPECT_LT((P - P_late).norm(), 1e-4 * P.norm());
}

TEST(RestPose, AveragesAcrossHalfATurn) {
  RestPose rest;
  for (int i = 0; i < 100; ++i) {
    const double noise = i % 2 == 0 ? 0.01 : -0.01;
    EXPECT_TRUE(rest.add({1 + noise, 2 - noise, kPi + noise - (i % 2) * kTwoPi}, {}));
  }
  EXPECT_NEAR(rest.mean()[0], 1, 1e-12);
  EXPECT_NEAR(std::abs(rest.mean()[2]), kPi, 1e-9);
}

TEST(RestPose, RefusesAWrongPoseAndComesOverToTenInARow) {
  RestPose rest;
  const ExternalPoseSettings settings;
  for (int i = 0; i < 20; ++i) rest.add({1, 2, 0.5}, settings);
  EXPECT_FALSE(rest.add({9, 2, 0.5}, settings));
  EXPECT_TRUE(rest.add({1, 2, 0.5}, settings));
  for (int i = 1; i < kPosesUntilBelieved; ++i) EXPECT_FALSE(rest.add({3, 2, -0.5}, settings));
  EXPECT_TRUE(rest.add({3, 2, -0.5}, settings));
  EXPECT_EQ(rest.samples(), 1);
  EXPECT_NEAR(rest.mean()[0], 3, 1e-12);
  EXPECT_NEAR(rest.mean()[2], -0.5, 1e-12);
}

}  // namespace
}  // namespace ballbot::test
