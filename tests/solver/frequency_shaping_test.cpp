#include "solver/frequency_shaping.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/riccati_impl.hpp"
#include "solver/shaped_input.hpp"

namespace ballbot {
namespace {

TEST(FrequencyShaping, LeavesSlowTorquesAloneAndWeighsFastOnesByRhoSquared) {
  const FrequencyShaping shaping{100, 200};
  EXPECT_NEAR(shaping.weightRatio(1e-3), 1, 1e-9);
  EXPECT_NEAR(shaping.weightRatio(1e6), 4, 1e-6);
  EXPECT_NEAR(shaping.weightRatio(100), (1 + 1.0) / (1 + 0.25), 1e-12);
}

TEST(FrequencyShaping, OneStepIsTheFiltersDifferentialEquationSolvedFinely) {
  const FrequencyShaping shaping{30, 300};
  const FilterStep step(shaping, 0.02);
  const double u = 1.7, rho = shaping.rho();
  double xf = -0.8, cost = 0;
  const double start = xf;
  const int fine = 200000;
  const double h = 0.02 / fine;
  for (int i = 0; i < fine; ++i) {  // midpoint rule
    const double middle = xf + 0.5 * h * shaping.pole * (u - xf);
    const double shaped = rho * u - (rho - 1) * middle;
    cost += h * shaped * shaped;
    xf += h * shaping.pole * (u - middle);
  }
  EXPECT_NEAR(step.next(start, u), xf, 1e-8);
  EXPECT_NEAR(step.cost(start, u), cost, 1e-8);
}

TEST(FrequencyShaping, AnOscillatingTorqueCostsWhatParsevalSays) {
  // Many short steps of a sine: mean of the shaped square is |r|^2 / 2.
  const FrequencyShaping shaping{50, 500};
  const double omega = 120, h = 1e-4;
  const FilterStep step(shaping, h);
  const int period = static_cast<int>(std::lround(2 * M_PI / omega / h));
  double xf = 0, cost = 0;
  for (int i = 0; i < 40 * period; ++i) {
    const double u = std::sin(omega * h * (i + 0.5));
    if (i >= 20 * period) cost += step.cost(xf, u);
    xf = step.next(xf, u);
  }
  EXPECT_NEAR(cost / (20 * period * h), shaping.weightRatio(omega) / 2,
              2e-3 * shaping.weightRatio(omega));
}

TEST(FrequencyShaping, IsMatchedToAnActuatorsBandwidth) {
  const FrequencyShaping shaping = FrequencyShaping::forBandwidth(10);
  EXPECT_NEAR(shaping.zero, 0.75 * 2 * M_PI * 10, 1e-9);
  EXPECT_NEAR(shaping.rho(), 15, 1e-12);
}

TEST(ShapedInput, ItsExpansionIsCentralDifferencesOfTheStepsCost) {
  const FilterStep step(FrequencyShaping{30, 300}, 0.02);
  const double w = 3, xf = -0.8, u = 1.7, d = 1e-4;
  LqStage<2, 1> lq;
  expandShapedCost(step, w, 1, 0, xf, u, lq);
  linearizeFilter(step, 1, 0, lq);
  const auto cost = [&](double a, double b) { return 0.5 * w * step.cost(a, b); };
  EXPECT_NEAR(lq.q()[1], (cost(xf + d, u) - cost(xf - d, u)) / (2 * d), 1e-9);
  EXPECT_NEAR(lq.r()[0], (cost(xf, u + d) - cost(xf, u - d)) / (2 * d), 1e-9);
  EXPECT_NEAR(lq.Q()(1, 1), (cost(xf + d, u) - 2 * cost(xf, u) + cost(xf - d, u)) / (d * d), 1e-6);
  EXPECT_NEAR(lq.R()(0, 0), (cost(xf, u + d) - 2 * cost(xf, u) + cost(xf, u - d)) / (d * d), 1e-6);
  EXPECT_NEAR(
      lq.Pt()(1, 0),
      (cost(xf + d, u + d) - cost(xf + d, u - d) - cost(xf - d, u + d) + cost(xf - d, u - d)) /
          (4 * d * d),
      1e-6);
  EXPECT_EQ(lq.Q()(0, 0), 0);
  EXPECT_NEAR(lq.A()(1, 1) * xf + lq.B()(1, 0) * u, step.next(xf, u), 1e-15);
}

TEST(ShapedInput, OverAShortStepItIsTheRateTimesItsLength) {
  const FrequencyShaping shaping{30, 300};
  const double h = 1e-7, w = 3, xf = -0.8, u = 1.7;
  const FilterStep step(shaping, h);
  LqStage<2, 1> stage, rates;
  expandShapedCost(step, w, 1, 0, xf, u, stage);
  linearizeFilter(step, 1, 0, stage);
  expandShapedRate(shaping, w, 1, 0, xf, u, rates);
  const auto expectNear = [h](double over_step, double rate) {
    EXPECT_NEAR(over_step / h, rate, 1e-4 * std::abs(rate));
  };
  expectNear(stage.q()[1], rates.q()[1]);
  expectNear(stage.r()[0], rates.r()[0]);
  expectNear(stage.Q()(1, 1), rates.Q()(1, 1));
  expectNear(stage.R()(0, 0), rates.R()(0, 0));
  expectNear(stage.Pt()(1, 0), rates.Pt()(1, 0));
  expectNear(stage.A()(1, 1) - 1, rates.A()(1, 1));
  expectNear(stage.B()(1, 0), rates.B()(1, 0));
}

}  // namespace
}  // namespace ballbot
