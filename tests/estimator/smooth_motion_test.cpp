// The generator the estimator's tests stand on, against finite differences of itself.
#include "tests/estimator/support/smooth_motion.hpp"

#include <gtest/gtest.h>

#include "model/frames.hpp"

namespace ballbot::test {
namespace {

TEST(SmoothMotion, DerivativesAgreeWithDifferences) {
  const RobotParameters robot = estimatorTestRobot();
  const MotionScript script = livelyMotion();
  const double d = 1e-5;
  for (const double t : {0.2, 0.9, 1.7, 2.4, 5.3, 11.0}) {
    const MotionSample a = sampleMotion(script, robot, t - d);
    const MotionSample b = sampleMotion(script, robot, t + d);
    const MotionSample m = sampleMotion(script, robot, t);
    EXPECT_LT(((b.p_WK - a.p_WK) / (2 * d) - m.v_WK_W).norm(), 1e-8) << t;
    EXPECT_LT((logSO3(a.R_WB.transpose() * b.R_WB) / (2 * d) - m.w_WB_B).norm(), 1e-8) << t;
  }
}

TEST(SmoothMotion, SpecificForceIsTheSecondDerivativeOfTheImuPositionLessGravity) {
  const RobotParameters robot = estimatorTestRobot();
  const MotionScript script = livelyMotion();
  const auto imu = [&](double t) {
    const MotionSample s = sampleMotion(script, robot, t);
    return Vector3(s.p_WK + s.R_WB * robot.p_BI_B);
  };
  const double d = 1e-3;
  for (const double t : {0.2, 0.9, 1.7, 2.4, 5.3, 11.0}) {
    const Vector3 a_W = (imu(t - d) - 2 * imu(t) + imu(t + d)) / (d * d);
    const MotionSample s = sampleMotion(script, robot, t);
    const Vector3 f_B = s.R_WB.transpose() * (a_W + robot.gravity * Vector3::UnitZ());
    // The difference itself is off by d^2/12 of the fourth derivative, some 1e2 m/s^4.
    EXPECT_LT((f_B - s.specific_force_B).norm(), 5e-5) << t;
  }
}

TEST(SmoothMotion, MeansTimesTimeAreIncrements) {
  const RobotParameters robot = estimatorTestRobot();
  const MotionScript script = livelyMotion();
  const double from = 3.0, to = 3.0025;
  const MotionMeans whole = averageMotion(script, robot, from, to);
  MotionMeans parts;
  const int n = 5;
  for (int i = 0; i < n; ++i) {
    const MotionMeans part =
        averageMotion(script, robot, from + (to - from) * i / n, from + (to - from) * (i + 1) / n);
    parts.wheel_rates += part.wheel_rates / n;
    parts.specific_force_B += part.specific_force_B / n;
  }
  EXPECT_LT((whole.wheel_rates - parts.wheel_rates).norm(), 1e-12);
  EXPECT_LT((whole.specific_force_B - parts.specific_force_B).norm(), 1e-12);
}

}  // namespace
}  // namespace ballbot::test
