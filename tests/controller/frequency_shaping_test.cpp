#include "controller/frequency_shaping.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

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
  const ConfigNode tree = parseYaml("{actuator_bandwidth_Hz: 10}", "mpc.yaml");
  ConfigReader in(tree);
  const FrequencyShaping shaping = FrequencyShaping::read(in);
  EXPECT_NEAR(shaping.zero, 0.75 * 2 * M_PI * 10, 1e-9);
  EXPECT_NEAR(shaping.rho(), 15, 1e-12);
}

TEST(FrequencyShaping, RefusesTwoWaysOfSayingIt) {
  const ConfigNode tree = parseYaml("{actuator_bandwidth_Hz: 10, zero_rad_per_s: 100}", "mpc.yaml");
  ConfigReader in(tree);
  try {
    FrequencyShaping::read(in);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("must be the one or the other"));
  }
}

TEST(FrequencyShaping, RefusesAPoleBelowTheZero) {
  const ConfigNode tree = parseYaml("{zero_rad_per_s: 100, pole_rad_per_s: 50}", "mpc.yaml");
  ConfigReader in(tree);
  try {
    FrequencyShaping::read(in);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("pole_rad_per_s is 50, must be between 100"));
  }
}

}  // namespace
}  // namespace ballbot
