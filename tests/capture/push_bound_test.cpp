#include "capture/push_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kAlongX = 0, kAlongY = M_PI / 2;

BalanceModel modelPushedAt(double height_m) {
  const RobotParameters robot = exampleRobot();
  return BalanceModel::of(robot, robot.nominal_arm, {0, 0, height_m});
}

BalanceLimits shippedLimits() { return {4, 12, 25 * M_PI / 180, 0.8}; }

/// A point mass on a leg whose foot is moved, u within +-1 of its middle:
/// dx/dt = v, dv/dt = w^2 (x - u) + f.
BalanceModel pendulum(double w) {
  BalanceModel m;
  m.A.setZero();
  m.B.setZero();
  m.E.setZero();
  m.wheel_rates.setZero();
  m.momentum_rate.setZero();
  m.torque_at_rest.setZero();
  m.A(0, 2) = 1;
  m.A(2, 0) = w * w;
  m.B(2, 0) = -w * w;
  m.E(2, 0) = 1;
  return m;
}

// xi = x + v / w obeys d xi/dt = w (xi - u) + f / w, and can be brought back while |xi| < 1. With
// u = 1 from `blind` on it is at the end of the push
//   xi = f/w^2 (e^(w T) - 1) - (e^(w (T - blind)) - 1), at most 1.
double largestOnPendulum(double w, double duration, double blind) {
  return w * w * std::exp(w * (duration - blind)) / (std::exp(w * duration) - 1);
}

TEST(LargestPush, OnAPendulumIsItsCapturePointsClosedForm) {
  const BalanceLimits only_foot{1, kNone, kNone, kNone};
  for (const double w : {3.0, 5.2}) {
    for (const double duration : {0.1, 0.5, 1.0}) {
      for (const double blind : {0.0, 0.06, 0.2}) {
        const PushTimes times{duration, blind, 4, 0.02};
        if (blind > duration) continue;
        const double expected = largestOnPendulum(w, duration, blind);
        // At the end of recovery it has to be at rest and not only on its way: e^(-w 4).
        EXPECT_NEAR(largestPush(pendulum(w), only_foot, times, 0), expected, 2e-3 * expected)
            << w << " rad/s, " << duration << " s, blind for " << blind << " s";
      }
    }
  }
}

/// What the modes that fall allow by themselves, each with its own best torques: from the left
/// eigenvectors l of A, z = l s obeys dz/dt = p z + l B u + l E f, and is lost for good beyond
/// |z| = max |l B u| / p.
double largestByModes(const BalanceModel& m, double torque, double direction,
                      const PushTimes& times) {
  const Eigen::EigenSolver<BalanceModel::StateMatrix> solver(m.A.transpose());
  const Eigen::Vector2d d(std::cos(direction), std::sin(direction));
  double least = kNone;
  for (int i = 0; i < BalanceModel::kStates; ++i) {
    const double p = solver.eigenvalues()[i].real();
    if (p < 1) continue;
    const BalanceModel::State l = solver.eigenvectors().col(i).real();
    const double held = torque * (l.transpose() * m.B).cwiseAbs().sum();
    const double pushed = std::abs(l.dot(m.E * d));
    const double T = times.duration_s;
    least =
        std::min(least, held / pushed * std::exp(p * (T - times.blind_s)) / (std::exp(p * T) - 1));
  }
  return least;
}

TEST(LargestPush, WithTorquesAloneLimitedIsWhatTheFallingModesAllow) {
  const BalanceModel model = modelPushedAt(0.35);
  const BalanceLimits only_torque{4, kNone, kNone, kNone};
  for (const double direction : {kAlongX, kAlongY}) {
    for (const double blind : {0.0, 0.06}) {
      const PushTimes times{0.5, blind, 4, 0.02};
      const double modes = largestByModes(model, 4, direction, times);
      const double got = largestPush(model, only_torque, times, direction);
      EXPECT_LE(got, modes * (1 + 1e-6));
      EXPECT_GE(got, modes * 0.98);
    }
  }
}

// Blind from beginning to end it stands only what changes nothing; traction counts from the first
// step on, and what a wheel bears is what the whole model says.
TEST(LargestPush, WithinTheWheelsFrictionIsLessTheLessThereIs) {
  const BalanceModel model = modelPushedAt(0.35);
  const PushTimes brief{0.3, 0, 2, 0.03};
  double before = 0;
  for (const double friction : {0.1, 0.3, 0.5, 0.8}) {
    BalanceLimits limits = shippedLimits();
    limits.wheel_friction = friction;
    const double force = largestPush(model, limits, brief, kAlongY);
    EXPECT_GT(force, before + 1) << friction;
    before = force;
  }
  EXPECT_LE(before, largestPush(model, shippedLimits(), brief, kAlongY) + 1e-6);
}

// Which of the limits counts depends on the others: the wheels' speed is what half a second comes
// to, friction and tilt where they are made to.
TEST(LargestPush, GrowsWithEachLimitThatCountsAndNeverShrinks) {
  const BalanceModel model = modelPushedAt(0.35);
  const PushTimes brief{0.3, 0, 1.5, 0.05};
  const auto along_x = [&](const BalanceLimits& limits) {
    return largestPush(model, limits, brief, kAlongX);
  };
  BalanceLimits tight = shippedLimits();
  tight.tilt = 4 * M_PI / 180;
  tight.floor_friction = 0.25;
  for (double BalanceLimits::*limit : {&BalanceLimits::wheel_torque, &BalanceLimits::wheel_speed,
                                       &BalanceLimits::tilt, &BalanceLimits::floor_friction}) {
    double before = 0;
    for (const double share : {0.6, 0.8, 1.0, 1.5, 3.0, kNone}) {
      BalanceLimits limits = tight;
      limits.*limit *= share;
      const double force = along_x(limits);
      EXPECT_GE(force, before - 1e-6) << share;
      if (share == 0.8) {
        EXPECT_GT(force, before * 1.001) << "this limit counts for nothing here";
      }
      before = force;
    }
  }
}

TEST(LargestPush, ShrinksWithDurationBlindnessAndHeight) {
  const PushTimes brief{0.3, 0, 2, 0.03};
  const auto force = [](double height, const PushTimes& times) {
    return largestPush(modelPushedAt(height), shippedLimits(), times, kAlongX);
  };
  const double known = force(0.35, brief);
  EXPECT_LT(force(0.35, {0.6, 0, 2, 0.03}), known);
  EXPECT_LT(force(0.35, {0.3, 0.09, 2, 0.03}), known);
  EXPECT_LT(force(0.6, brief), known);
  // Who is blind all along can take none but by chance; the robot falls from any push.
  EXPECT_LT(force(0.35, {0.3, 2.3, 2, 0.03}), 1e-6);
}

// The forces that can be survived are a convex set, since every law of the program is linear.
TEST(LargestPush, BetweenTwoDirectionsIsAtLeastTheChord) {
  const BalanceModel model = modelPushedAt(0.35);
  const PushTimes brief{0.3, 0, 2, 0.03};
  const auto force = [&](double direction) {
    return largestPush(model, shippedLimits(), brief, direction);
  };
  const double half = M_PI / 6;
  const double chord = std::cos(half) * std::min(force(0), force(2 * half));
  EXPECT_GE(force(half), chord - 1e-6);
}

TEST(LargestPush, HardlyDependsOnHowFinelyTimeIsCut) {
  const BalanceModel model = modelPushedAt(0.35);
  const double coarse = largestPush(model, shippedLimits(), {0.5, 0.06, 3, 0.04}, kAlongY);
  const double fine = largestPush(model, shippedLimits(), {0.5, 0.06, 3, 0.01}, kAlongY);
  EXPECT_NEAR(coarse, fine, 0.005 * fine);
  EXPECT_LE(coarse, fine * (1 + 1e-3)) << "more freedom, less force";
}

}  // namespace
}  // namespace ballbot
