#include "estimator/balance_aiding.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "estimator/two_state_filter.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/driven_robot.hpp"

namespace ballbot::test {
namespace {

const Vector3 kBias(0.07, -0.05, 0.02);  // 0.5 degrees of tilt, were it one [m/s^2]

TwoStateSettings settings(bool aided) {
  TwoStateSettings s;
  s.balance.enabled = aided;
  return s;
}

/// A filter on what a driven robot senses.
struct Trial {
  explicit Trial(const TwoStateSettings& s, std::uint64_t seed = 1)
      : plant(seed), filter(plant.robot(), s) {
    plant.accel_bias = kBias;
  }
  void until(double time_s, const Vector3& force_W = Vector3::Zero()) {
    while (plant.time_s() < time_s - 1e-9) {
      plant.advance(force_W);
      filter.update(plant.frame(), plant.atRest());
    }
  }
  Matrix3 truth() const {
    const StateVector& x = plant.x();
    return rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
  }
  double tiltErrorDeg() const {
    return ((filter.state().R_WB - truth()).transpose() * Vector3::UnitZ()).norm() / kRadPerDeg;
  }
  DrivenRobot plant;
  TwoStateFilter filter;
};

TEST(BalanceAiding, TellsTiltFromAccelerometerBias) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Trial with(settings(true), seed), without(settings(false), seed);
    with.until(2.5);
    without.until(2.5);
    EXPECT_GT(without.tiltErrorDeg(), 0.35) << "seed " << seed;
    // What is known of a bias at all still has its weight: 0.17 degrees against 0.09.
    EXPECT_LT(with.tiltErrorDeg(), 0.35 * without.tiltErrorDeg()) << "seed " << seed;
    EXPECT_LT((with.filter.state().accel_bias - kBias).norm(), 0.03);
  }
}

TEST(BalanceAiding, StandingStillIsEnough) {
  Trial run(settings(true));
  run.plant.sway_m = 0;
  run.until(4);
  EXPECT_LT(run.tiltErrorDeg(), 0.16);
}

TEST(BalanceAiding, APushIsNoTilt) {
  for (const Vector3& force : {Vector3(15, 0, 0), Vector3(0, -6, 0), Vector3(3, 3, 0)}) {
    Trial with(settings(true)), without(settings(false));
    for (Trial* run : {&with, &without}) {
      run->until(4);
      run->until(4.5, force);
    }
    EXPECT_LT(with.tiltErrorDeg(), 0.16) << force.transpose();
    with.until(7);
    EXPECT_LT(with.tiltErrorDeg(), 0.16) << force.transpose();
    EXPECT_EQ(with.filter.rejections().total(), without.filter.rejections().total());
  }
}

// 5 N that never end would be 5 degrees if they were taken for one.
TEST(BalanceAiding, ALastingPushIsNoTilt) {
  Trial run(settings(true));
  run.until(3);
  run.until(12, Vector3(5, 0, 0));
  EXPECT_LT(run.tiltErrorDeg(), 0.2);
}

TEST(BalanceAiding, IsNeverSurerThanTheModelIsKnown) {
  TwoStateSettings loose = settings(true), tight = settings(true);
  loose.balance.moment_sigma = 0.1;
  tight.balance.moment_sigma = 0.03;
  for (const TwoStateSettings& s : {loose, tight}) {
    Trial run(s);
    run.plant.sway_m = 0;  // so that nothing else tells the tilt
    run.until(10);
    PositionVector q = PositionVector::Zero();
    q.segment<3>(kArm1) = run.plant.robot().nominal_arm;
    const RobotParameters& robot = run.plant.robot();
    const double height_moment = gravityAboutContact(ReducedDynamics(robot), q).height_moment;
    const double stiffness =
        robot.gravity * (height_moment - robot.totalMass() * robot.ball.radius);
    const double sigma = run.filter.estimate(run.plant.frame().time).sigma[2];
    const double known = s.balance.moment_sigma / stiffness;
    EXPECT_GT(sigma, 0.9 * known);
    EXPECT_LT(sigma, 2 * known + 0.03 * kRadPerDeg);
  }
}

TEST(BalanceAiding, ContinuesBitForBitAfterRestore) {
  Trial one(settings(true)), other(settings(true));
  one.until(1.33);  // within a window
  other.until(0.4);
  other.plant = one.plant;
  other.filter.restoreState(one.filter.saveState());
  one.until(2);
  other.until(2);
  EXPECT_EQ(one.filter.saveState(), other.filter.saveState());
}

}  // namespace
}  // namespace ballbot::test
