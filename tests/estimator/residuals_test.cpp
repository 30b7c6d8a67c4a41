#include "estimator/residuals.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

using SpinTangent = BasicTangentVector<kSpinTangentDim>;

/// Two states and a measurement with nothing special about them. The state's velocities are those
/// at which the residuals are differentiated, so that derivatives are exact.
struct Case {
  FilterState a, b;
  IntervalMeasurement m;
};

Case randomCase(std::uint64_t seed) {
  const RandomStream random(seed, "residuals");
  std::uint64_t at = 0;
  const auto draw = [&](double scale) {
    const auto n = random.normals(at++);
    return Vector3(scale * Vector3(n[0], n[1], n[2]));
  };
  Case c;
  c.a.p_WK_W = draw(1.0).head<2>();
  c.a.R_WB = expSO3(draw(0.5));
  c.a.v_WK_W = draw(0.5).head<2>();
  c.a.w_WB_B = draw(0.5);
  c.a.accel_bias = draw(0.05);
  c.a.gyro_bias = draw(0.01);
  c.a.spin = draw(1.0).x();
  SpinTangent step;
  step.segment<2>(0) = draw(1e-2).head<2>();
  step.segment<3>(2) = draw(5e-2);
  step.segment<2>(5) = draw(1e-2).head<2>();
  step.segment<3>(7) = draw(0.1);
  step.segment<3>(10) = draw(0.01);
  step.segment<3>(13) = draw(0.01);
  step[kTanSpin] = draw(0.1).x();
  c.b = c.a.plus(step);
  c.m.h = 2.5e-3;
  c.m.has_accel = c.m.has_gyro = true;
  c.m.accel_B = draw(1.0) + Vector3(0, 0, 9.81);
  c.m.gyro_B = draw(0.5);
  c.m.has_wheel.fill(true);
  c.m.wheel_increment = draw(0.01);
  c.m.smooth_v_old_W = c.a.v_WK_W;
  c.m.smooth_v_new_W = c.b.v_WK_W;
  c.m.spin_kept = 0.9;
  c.m.spin_sigma = 0.05;
  c.m.smooth_spin = c.b.spin;
  return c;
}

ResidualVector residuals(const ResidualModel& model, const FilterState& a, const FilterState& b,
                         const IntervalMeasurement& m) {
  Residuals r;
  model.evaluate(a, b, m, r);
  return r.y;
}

/// Largest entry of `analytic` - central differences, row by row relative to the row's largest.
double jacobianError(const ResidualJacobian& analytic,
                     const std::function<ResidualVector(const SpinTangent&)>& f) {
  const double d = 1e-6;
  ResidualJacobian numeric;
  for (int i = 0; i < kSpinTangentDim; ++i) {
    const SpinTangent step = d * SpinTangent::Unit(i), back = -step;
    numeric.col(i) = (f(step) - f(back)) / (2 * d);
  }
  const ResidualVector scale = analytic.rowwise().lpNorm<Eigen::Infinity>();
  return ((analytic - numeric).array().colwise() / scale.array().max(1e-12)).abs().maxCoeff();
}

TEST(Residuals, DerivativesAgreeWithCentralDifferences) {
  const ResidualModel model(estimatorTestRobot(), FilterNoise{});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Case c = randomCase(seed);
    c.m.has_accel = seed % 4 != 1;
    c.m.has_gyro = seed % 4 != 2;
    Residuals r;
    model.evaluate(c.a, c.b, c.m, r);
    EXPECT_LT(
        jacobianError(
            r.d_new, [&](const SpinTangent& d) { return residuals(model, c.a, c.b.plus(d), c.m); }),
        1e-6)
        << seed;
    // Not every residual knows the old state: rows of zeros are compared as they are.
    ResidualJacobian d_old = r.d_old;
    EXPECT_LT(
        jacobianError(
            d_old, [&](const SpinTangent& d) { return residuals(model, c.a.plus(d), c.b, c.m); }),
        1e-6)
        << seed;
  }
}

TEST(Residuals, AreEvaluatedAfreshWhenASensorComesBack) {
  const ResidualModel model(estimatorTestRobot(), FilterNoise{});
  Case c = randomCase(3);
  Residuals fresh, reused;
  model.evaluate(c.a, c.b, c.m, fresh);
  c.m.has_accel = c.m.has_gyro = false;
  model.evaluate(c.a, c.b, c.m, reused);
  c.m.has_accel = c.m.has_gyro = true;
  model.evaluate(c.a, c.b, c.m, reused);
  EXPECT_EQ(fresh.y, reused.y);
  EXPECT_EQ(fresh.d_old, reused.d_old);
  EXPECT_EQ(fresh.d_new, reused.d_new);
}

/// The world turned by `angle` about z.
FilterState turned(const FilterState& x, double angle) {
  const Matrix3 Rz = rotationFromYawPitchRoll(angle, 0, 0);
  FilterState y = x;
  y.p_WK_W = Rz.topLeftCorner<2, 2>() * x.p_WK_W;
  y.R_WB = Rz * x.R_WB;
  y.v_WK_W = Rz.topLeftCorner<2, 2>() * x.v_WK_W;
  return y;
}

TEST(Residuals, DoNotKnowNorth) {
  const ResidualModel model(estimatorTestRobot(), FilterNoise{});
  for (const double angle : {0.3, 2.0, -3.0}) {
    const Case c = randomCase(11);
    ResidualVector expected = residuals(model, c.a, c.b, c.m);
    // The position residual is a vector of W and turns along.
    expected.segment<2>(kRowPosition) =
        rotationFromYawPitchRoll(angle, 0, 0).topLeftCorner<2, 2>() *
        expected.segment<2>(kRowPosition);
    const ResidualVector r = residuals(model, turned(c.a, angle), turned(c.b, angle), c.m);
    EXPECT_LT((r - expected).norm(), 1e-9 * expected.norm()) << angle;
  }
}

TEST(Residuals, YawIsFreeInTheLinearisationToo) {
  // Turning old and new state, at the smooth velocity instead of their own, changes nothing: the
  // property that keeps the filter from learning yaw out of noise.
  const ResidualModel model(estimatorTestRobot(), FilterNoise{});
  Case c = randomCase(5);
  c.m.smooth_v_old_W << 0.2, -0.1;
  c.m.smooth_v_new_W << 0.21, -0.13;
  c.m.smooth_spin = 1.7;
  Residuals r;
  model.evaluate(c.a, c.b, c.m, r);
  const auto yaw_direction = [](const FilterState& x, const Eigen::Vector2d& v) {
    SpinTangent d = SpinTangent::Zero();
    d.segment<3>(kTanAttitude) = x.R_WB.transpose() * Vector3::UnitZ();
    d.segment<2>(kTanVelocity) << -v.y(), v.x();
    return d;
  };
  const ResidualVector change = r.d_old * yaw_direction(c.a, c.m.smooth_v_old_W) +
                                r.d_new * yaw_direction(c.b, c.m.smooth_v_new_W);
  // Position is left out: turning it about the origin takes its own place, which is not among the
  // arguments; the residual is linear in it.
  const double scale = r.d_new.middleRows<12>(kRowAttitude).norm();
  EXPECT_LT(change.segment<12>(kRowAttitude).norm(), 1e-12 * scale);
}

TEST(Residuals, VanishOnARealMotion) {
  const RobotParameters robot = estimatorTestRobot();
  const ResidualModel model(robot, FilterNoise{});
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 1);
  FilterState a;
  Vector3 wheels = Vector3::Zero();
  double largest = 0;
  while (sensors.truth().t_s < 6) {
    sensors.advance();
    const SensorFrame& f = sensors.frame();
    const FilterState b = truthAsFilterState(sensors.truth());
    IntervalMeasurement m;
    m.h = 2.5e-3;
    m.has_accel = m.has_gyro = true;
    m.accel_B = f.accel_B;
    m.gyro_B = f.gyro_WB_B;
    m.has_wheel.fill(true);
    m.wheel_increment = f.joint_angle.head<3>() - wheels;
    if (sensors.truth().t_s > 1) {
      largest = std::max(largest, residuals(model, a, b, m).lpNorm<Eigen::Infinity>());
    }
    a = b;
    wheels = f.joint_angle.head<3>();
  }
  // What is left is the lever arm's half interval of lag and the integration rules, in standard
  // deviations of the noise.
  EXPECT_LT(largest, 0.06);
}

TEST(Residuals, TellASpinOfTheBallFromATurnOfTheBase) {
  // Base and ball turning alike leave the wheels where they are; the gyroscope notices.
  const ResidualModel model(estimatorTestRobot(), FilterNoise{});
  Case c = randomCase(8);
  c.a.R_WB = c.b.R_WB = expSO3(Vector3(0.1, -0.2, 0.4));
  const ResidualVector before = residuals(model, c.a, c.b, c.m);
  c.b.spin += 0.7;
  c.b.w_WB_B += c.b.R_WB.transpose() * Vector3(0, 0, 0.7);
  const ResidualVector after = residuals(model, c.a, c.b, c.m);
  EXPECT_LT((after - before).segment<3>(kRowWheels).norm(), 1e-12 * before.norm());
  EXPECT_GT((after - before).segment<3>(kRowGyro).norm(), 100);
  EXPECT_NEAR((after - before)[kRowSpin], 0.7 / 0.05, 1e-9);
}

TEST(Residuals, VanishForABallThatSpins) {
  const RobotParameters robot = estimatorTestRobot();
  const ResidualModel model(robot, FilterNoise{});
  MotionScript script = livelyMotion();
  script.spins = {{1, 10, 2, 0}};
  SimulatedSensors sensors(script, robot, noNoise(), 1);
  while (sensors.truth().t_s < 5) sensors.advance();
  const FilterState a = truthAsFilterState(sensors.truth());
  const Vector3 wheels = sensors.frame().joint_angle.head<3>();
  sensors.advance();
  const FilterState b = truthAsFilterState(sensors.truth());
  IntervalMeasurement m;
  m.h = 2.5e-3;
  m.has_wheel.fill(true);
  m.wheel_increment = sensors.frame().joint_angle.head<3>() - wheels;
  EXPECT_EQ(b.spin, 2);
  EXPECT_LT((residuals(model, a, b, m).segment<3>(kRowWheels).norm()), 1e-3);
  FilterState still = b;
  still.spin = 0;
  EXPECT_GT((residuals(model, a, still, m).segment<3>(kRowWheels).norm()), 20);
}

TEST(Residuals, PredictLandsOnTheMotion) {
  const RobotParameters robot = estimatorTestRobot();
  const ResidualModel model(robot, FilterNoise{});
  SimulatedSensors sensors(livelyMotion(), robot, noNoise(), 1);
  while (sensors.truth().t_s < 4) sensors.advance();
  const FilterState a = truthAsFilterState(sensors.truth());
  sensors.advance();
  IntervalMeasurement m;
  m.h = 2.5e-3;
  m.has_accel = m.has_gyro = true;
  m.accel_B = sensors.frame().accel_B;
  m.gyro_B = sensors.frame().gyro_WB_B;
  const TangentVector off = truthAsFilterState(sensors.truth()).minus(model.predict(a, m));
  EXPECT_LT(off.segment<3>(kTanAttitude).norm(), 1e-8);
  EXPECT_LT(off.segment<2>(kTanVelocity).norm(), 2e-5);
  EXPECT_LT(off.segment<2>(kTanPosition).norm(), 1e-7);
}

}  // namespace
}  // namespace ballbot::test
