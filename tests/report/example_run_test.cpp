// The example that the tests of the page look at must be a motion that could happen.
#include "tests/report/example_run.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/report/pendulum.hpp"

namespace ballbot {
namespace {

TEST(ExamplePendulum, KeepsItsEnergyWhenNobodyDrivesIt) {
  Pendulum free;
  free.lean = 0.05;
  const double before = free.energy();
  for (int i = 0; i < 20000; ++i) free.step(1e-4, 0, {});  // it swings through below
  EXPECT_GT(std::abs(free.lean), 1.0);
  EXPECT_NEAR(free.energy(), before, 1e-6 * Pendulum::kBodyMass * Pendulum::kGravity);
}

TEST(ExamplePendulum, GainsTheWorkOfTorqueAndForce) {
  Pendulum driven;
  const double h = 1e-4, force = 20, height = 0.35;
  double work = 0;
  for (int i = 0; i < 5000; ++i) {
    const double torque = driven.balancingTorque();
    const Pendulum before = driven;
    driven.step(h, torque, {{{force, height}, {}}});
    const double roll = (driven.x - before.x) / Pendulum::kBallRadius;
    const double lean = driven.lean - before.lean;
    work += torque * (roll - lean);
    work +=
        force * (driven.x - before.x + height * (std::sin(driven.lean) - std::sin(before.lean)));
  }
  EXPECT_NEAR(driven.energy(), work, 1e-9 * std::abs(work) + 1e-9);
}

TEST(ExampleRun, IsPushedTouchesTheWallAndComesToRest) {
  const ReportData run = exampleRun();
  ASSERT_EQ(run.phases.size(), 3u);
  EXPECT_EQ(run.phases[2].kind, ReportPhase::Kind::kContact);
  EXPECT_GT(run.phases[2].start_s, 5.0);
  EXPECT_GT(run.phases[2].end_s - run.phases[2].start_s, 0.1);
  for (const auto& force : run.replay->forces[1].force_W) EXPECT_LE(force[0], 0) << "a wall pulls";
  const auto& rest = run.replay->bodies[0].poses.back();
  EXPECT_NEAR(rest.p_W[0], 0, 0.01);
  EXPECT_NEAR(rest.p_W[1], 0, 0.01);
  EXPECT_NEAR(rest.quat_W[0], 1, 1e-4);
}

TEST(ExampleRun, RollsWithoutSlip) {
  const ReportData run = exampleRun();
  const auto& ball = run.replay->bodies[1].poses;
  // Angular velocity from consecutive orientations, dq = q2 q1*: the contact point stands still.
  for (std::size_t i = 100; i + 1 < ball.size(); i += 397) {
    const auto &a = ball[i].quat_W, &b = ball[i + 1].quat_W;
    const double wx = 2 * (-b[0] * a[1] + b[1] * a[0] - b[2] * a[3] + b[3] * a[2]);
    const double wy = 2 * (-b[0] * a[2] + b[1] * a[3] + b[2] * a[0] - b[3] * a[1]);
    const double dx = ball[i + 1].p_W[0] - ball[i].p_W[0];
    const double dy = ball[i + 1].p_W[1] - ball[i].p_W[1];
    EXPECT_NEAR(dx, Pendulum::kBallRadius * wy, 2e-5);
    EXPECT_NEAR(dy, -Pendulum::kBallRadius * wx, 2e-5);
  }
}

}  // namespace
}  // namespace ballbot
