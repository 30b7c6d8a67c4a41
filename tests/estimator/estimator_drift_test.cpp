// How far off is the position after a way without an outside measurement? It depends on the way:
// what a wrong yaw or a wrong wheel radius adds outwards it takes away on the way home. Prints the
// table of docs/theory/estimator.md; label sim.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

/// `metres` straight ahead in `seconds`, tilting a little.
MotionScript straightAhead(double metres, double seconds) {
  MotionScript m = livelyMotion();
  m.harmonics[0] = {{metres, 0.25 / seconds, -kTwoPi / 4}};  // metres (1 - cos)
  m.harmonics[1] = m.harmonics[2] = {};
  return m;
}

struct Drift {
  double position_m = 0;  ///< rms over the seeds, at the end
  double distance_m = 0;
  double percent() const { return 100 * position_m / distance_m; }
};

Drift drift(const char* name, const MotionScript& script, double seconds, double wheel_factor,
            double ball_factor = 1) {
  constexpr int kSeeds = 6;
  Drift d;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    FilterRun run;
    run.script = script;
    run.seconds = seconds + script.rest_s;
    run.seed = static_cast<std::uint64_t>(seed);
    run.believed.wheels.radius *= wheel_factor;
    run.believed.ball.radius *= ball_factor;
    const RunErrors e = play(run);
    d.position_m += e.position_end * e.position_end / kSeeds;
    d.distance_m = e.distance;
  }
  d.position_m = std::sqrt(d.position_m);
  std::printf("%-36s %5.1f m  %7.4f m  %6.3f %%\n", name, d.distance_m, d.position_m, d.percent());
  return d;
}

TEST(EstimatorDrift, IsSmallWhereTheWayComesBack) {
  EXPECT_LT(drift("wandering, back near its start", livelyMotion(), 60, 1).percent(), 0.05);
}

TEST(EstimatorDrift, OfAStraightWayGrowsWithTheErrorOfYaw) {
  const Drift near = drift("straight, 5 m", straightAhead(5, 10), 10, 1);
  const Drift far = drift("straight, 30 m", straightAhead(30, 60), 60, 1);
  EXPECT_GT(near.percent(), 0.05);
  EXPECT_LT(near.percent(), 0.6);
  EXPECT_GT(far.percent(), near.percent());
  EXPECT_LT(far.percent(), 2);
}

TEST(EstimatorDrift, OfAWrongWheelRadiusIsThatRadius) {
  const Drift d = drift("straight, 5 m, wheels 1 % too large", straightAhead(5, 10), 10, 1.01);
  EXPECT_NEAR(d.percent(), 1, 0.3);
  // On the way home the same error has the other sign.
  EXPECT_LT(drift("wandering, wheels 1 % too large", livelyMotion(), 60, 1.01).percent(), 0.2);
}

TEST(EstimatorDrift, TheBallsRadiusDropsOut) {
  // Wheels and floor touch the same ball: what a wheel rolls, the ball's centre moves.
  const Drift d = drift("straight, 5 m, ball 1 % too large", straightAhead(5, 10), 10, 1, 1.01);
  EXPECT_LT(d.percent(), 0.3);
}

}  // namespace
}  // namespace ballbot::test
