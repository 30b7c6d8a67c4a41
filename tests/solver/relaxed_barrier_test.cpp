#include "solver/relaxed_barrier.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(RelaxedBarrier, ValueSlopeAndCurvatureAreContinuousAtTheSwitch) {
  const RelaxedBarrier barrier{0.3, 0.2};
  const double just = 1e-12;
  const auto above = barrier.derivatives(barrier.delta + just);
  const auto below = barrier.derivatives(barrier.delta - just);
  EXPECT_NEAR(above.value, below.value, 1e-10);
  EXPECT_NEAR(above.first, below.first, 1e-9);
  EXPECT_NEAR(above.second, below.second, 1e-8);
}

TEST(RelaxedBarrier, DerivativesAreCentralDifferencesOnBothSides) {
  const RelaxedBarrier barrier{0.3, 0.2};
  const double step = 1e-6;
  for (const double h : {-3.0, -0.1, 0.1, 0.19, 0.21, 1.0, 20.0}) {
    const auto d = barrier.derivatives(h);
    EXPECT_EQ(d.value, barrier.value(h));
    EXPECT_NEAR(d.first, (barrier.value(h + step) - barrier.value(h - step)) / (2 * step), 1e-7);
    const double second =
        (barrier.derivatives(h + step).first - barrier.derivatives(h - step).first) / (2 * step);
    EXPECT_NEAR(d.second, second, 1e-7);
  }
}

TEST(RelaxedBarrier, PushesInwardEverywhere) {
  const RelaxedBarrier barrier{0.3, 0.2};
  double last = barrier.value(-5);
  for (double h = -4.9; h < 0.35; h += 0.1) {
    EXPECT_LT(barrier.derivatives(h).first, 0) << h;
    EXPECT_LT(barrier.value(h), last) << h;
    last = barrier.value(h);
  }
}

}  // namespace
}  // namespace ballbot
