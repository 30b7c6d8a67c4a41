// The loop that `ballbot bode` takes margins of, against the robot that it is to stand for, against
// a loop in continuous time, and against itself.
#include "experiment/sampled_loop.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "cosim/lifecycle.hpp"
#include "cosim/step_master.hpp"
#include "experiment/loop_margins.hpp"
#include "experiment/plant_factory.hpp"
#include "experiment/robot_controller.hpp"
#include "experiment/scenario.hpp"
#include "tests/controller/support/continuous_margins.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

RunConfig balance(std::vector<std::string> overrides) {
  for (const char* common : {"plant.fidelity.sensors=perfect", "plant.fidelity.friction=false",
                             "plant.fidelity.multibody=reduced_wheels", "requirements={}"}) {
    overrides.insert(overrides.begin(), common);
  }
  return readRunConfig(
      loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml", overrides));
}

using Trace = std::vector<StateVector>;

/// True states of the whole robot from its release until it has fallen, one every 10 ms.
Trace robot(const RunConfig& config) {
  EventCalendar calendar(config.scenario.rates.base_step);
  RobotController controller(config, calendar);
  Lifecycle plant(makePlant(config.plant));
  MasterOptions options;
  options.end = kSimStart + config.scenario.duration;
  StepMaster master(plant, controller, calendar, nullptr, options);
  Trace out;
  master.setObserver([&](const Tick& tick) {
    if (tick.time >= config.scenario.release && toNs(tick.time) % 10'000'000 == 0) {
      out.push_back(tick.truth->state);
    }
    return std::abs(tick.truth->state[kPitch]) < 0.7;  // it has not fallen
  });
  master.initialize();
  while (master.step()) {
  }
  master.terminate();
  return out;
}

/// What becomes of a small difference between two starts.
Trace robotsAnswer(std::vector<std::string> overrides, const std::string& duration) {
  overrides.insert(overrides.end(), {duration, "initial={pitch_deg: 1.2, release_s: 0.5}"});
  const Trace before = robot(balance(overrides));
  overrides.back() = "initial={pitch_deg: 1.22, roll_deg: 0.01, release_s: 0.5}";
  Trace after = robot(balance(overrides));
  after.resize(std::min(before.size(), after.size()));
  for (std::size_t i = 0; i < after.size(); ++i) after[i] -= before[i];
  return after;
}

/// The same of the linear loop: held still until the release, then free.
Trace loopsAnswer(const RunConfig& config) {
  const SampledLoop loop(config, kSimStart);
  StateVector start = StateVector::Zero();
  start[kPitch] = 0.02 * M_PI / 180;
  start[kRoll] = 0.01 * M_PI / 180;
  Eigen::VectorXd z = Eigen::VectorXd::Zero(loop.dim({}));
  z.segment<kStateDim>(SampledLoop::kRobot) = start;
  Trace out;
  SimTime t = kSimStart;
  const SimTime end = kSimStart + config.scenario.duration;
  for (std::size_t n = 0; t <= end; n = (n + 1) % loop.schedule().events.size()) {
    if (t >= config.scenario.release && toNs(t) % 10'000'000 == 0) {
      out.push_back(z.segment<kStateDim>(SampledLoop::kRobot));
    }
    loop.pass(n, {}, z);
    t += loop.schedule().events[n].until_next;
    if (t <= config.scenario.release) z.segment<kStateDim>(SampledLoop::kRobot) = start;
  }
  return out;
}

/// How far two traces are apart at most, relative to the larger one's largest value, of one
/// element.
double apart(const Trace& a, const Trace& b, int element) {
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max({largest, std::abs(a[i][element]), std::abs(b[i][element])});
    apart = std::max(apart, std::abs(a[i][element] - b[i][element]));
  }
  return apart / largest;
}

class FreeResponse : public ::testing::TestWithParam<const char*> {};

TEST_P(FreeResponse, IsThatOfTheRobot) {
  const std::vector<std::string> overrides = {GetParam()};
  const Trace real = robotsAnswer(overrides, "duration_s=2");
  const Trace linear = loopsAnswer(balance({GetParam(), "duration_s=2", "initial.release_s=0.5"}));
  ASSERT_EQ(real.size(), linear.size());
  ASSERT_GT(real.size(), 140u);
  for (const int element :
       {static_cast<int>(kBallX), static_cast<int>(kBallY), static_cast<int>(kPitch),
        static_cast<int>(kRoll), static_cast<int>(kArm1 + 1), kPositionDim + kBallVx}) {
    EXPECT_LT(apart(real, linear, element), 0.05) << "element " << element;
  }
}

INSTANTIATE_TEST_SUITE_P(SampledLoop, FreeResponse,
                         ::testing::Values("controller.kind=mpc",
                                           "controller.tracker.policy_feedback=0",
                                           "controller.kind=lqr"));

/// Largest of a second of a trace that ends at `end` [samples].
double largestBefore(const Trace& trace, std::size_t end) {
  double largest = 0;
  for (std::size_t i = end - 100; i < end; ++i) largest = std::max(largest, trace[i].norm());
  return largest;
}

/// Whether a small disturbance of the robot is larger at last than it was at first.
bool grows(const char* law, const std::string& inserted) {
  const Trace answer = robotsAnswer({law, inserted}, "duration_s=6.5");
  return answer.size() < 600 || largestBefore(answer, answer.size()) > largestBefore(answer, 100);
}

class SmallSignal : public ::testing::TestWithParam<const char*> {};

TEST_P(SmallSignal, GrowsOnTheRobotWithATenthMoreDelayThanTheMarginAndDiesWithATenthLess) {
  const SampledMargins margins = marginsOf(SampledLoop(balance({GetParam()}), kSimStart));
  ASSERT_TRUE(margins.stable);
  const auto ticks = [](double factor, double seconds) {
    return std::to_string(std::lround(factor * seconds / 4e-4));
  };
  const std::string wheels = "plant.wheel_loop_insertion.delay_ticks=";
  EXPECT_FALSE(grows(GetParam(), wheels + ticks(0.9, margins.wheel_delay_margin)));
  EXPECT_TRUE(grows(GetParam(), wheels + ticks(1.1, margins.wheel_delay_margin)));
  const std::string all = "plant.transport_delay_ticks=";  // of which there are two
  EXPECT_FALSE(grows(GetParam(), all + ticks(0.9, margins.delay_margin + 8e-4)));
  EXPECT_TRUE(grows(GetParam(), all + ticks(1.1, margins.delay_margin + 8e-4)));
}

INSTANTIATE_TEST_SUITE_P(SampledLoop, SmallSignal,
                         ::testing::Values("controller.kind=mpc",
                                           "controller.tracker.policy_feedback=0",
                                           "controller.kind=lqr"));

TEST(SampledLoop, GrowsAsTheEigenvaluesOfItsMatrixSay) {
  const SampledLoop loop(balance({}), kSimStart);
  const LoopProbe probe{1.5, 20, 3};
  const int n = loop.dim(probe);
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i) loop.advance(probe, M.col(i));
  const double period = toSeconds(loop.schedule().period);
  EXPECT_NEAR(loop.growthRate(probe), std::log(eigenvaluesOf(M).cwiseAbs().maxCoeff()) / period,
              1e-5);
}

TEST(SampledLoop, AProbeIsWhatTheScenarioCanInsertItself) {
  const SampledLoop plain(balance({}), kSimStart);
  const SampledLoop inserted(balance({"plant.wheel_loop_insertion={gain: 2, delay_ticks: 60}"}),
                             kSimStart);
  const SampledLoop late(balance({"plant.transport_delay_ticks=12"}), kSimStart);
  EXPECT_NEAR(plain.growthRate({2, 60, 0}), inserted.growthRate({}), 1e-6);
  EXPECT_NEAR(plain.growthRate({1, 0, 10}), late.growthRate({}), 1e-6);
}

/// An LQR on ideal drives without any delay, all of it every 100 us.
RunConfig prompt() {
  return balance({"controller={include: " BALLBOT_SOURCE_DIR "/configs/controllers/lqr.yaml}",
                  "plant={include: " BALLBOT_SOURCE_DIR "/configs/plants/ideal.yaml}",
                  "plant.drive_period_us=100", "plant.substep_us=100",
                  "robot.sensors.imu.period_ms=0.1", "estimator.arm_rate_time_constant_s=0",
                  "rates={tracker_period_us: 100, estimator_period_us: 100, planner_period_us: "
                  "100, plan_latency_us: 0}"});
}

TEST(SampledLoop, OfFastRatesHasThePolesOfTheContinuousLoop) {
  const RunConfig config = prompt();
  const SampledLoop loop(config, kSimStart);
  ASSERT_EQ(toNs(loop.schedule().period), 100'000);
  const ReducedDynamics dynamics(config.believedRobot());
  const auto cost = config.controller.law->costAt(kSimStart, config.robot.nominal_arm);
  const ShapedLqr law =
      designShapedLqr(dynamics, config.robot.nominal_arm, cost->Q, cost->R, cost->shaping);
  const double slowest = TorqueLoop(law, dynamics, std::nullopt, 0).slowestPoleWithoutDelay();
  EXPECT_NEAR(loop.growthRate({}), slowest, 0.005 * std::abs(slowest));
}

TEST(SampledLoop, OfFastRatesHasTheMarginsOfTheContinuousLoop) {
  const RunConfig config = prompt();
  const SampledLoop loop(config, kSimStart);
  const ReducedDynamics dynamics(config.believedRobot());
  const auto cost = config.controller.law->costAt(kSimStart, config.robot.nominal_arm);
  const ShapedLqr law =
      designShapedLqr(dynamics, config.robot.nominal_arm, cost->Q, cost->R, cost->shaping);
  // What holding for a tick, and rates as means over one, amount to.
  const double delay = 1e-4;
  const ContinuousMargins continuous = continuousMargins(law, dynamics, std::nullopt, delay);
  const SampledMargins sampled = marginsOf(loop);
  ASSERT_TRUE(sampled.stable);
  EXPECT_NEAR(sampled.delay_margin, continuous.delay_margin, 0.02 * continuous.delay_margin);
  EXPECT_NEAR(sampled.wheel_delay_margin, continuous.wheel_delay_margin,
              0.02 * continuous.wheel_delay_margin);
  EXPECT_NEAR(sampled.wheel_gain_low, continuous.wheel_gain_low, 0.02 * continuous.wheel_gain_low);
}

}  // namespace
}  // namespace ballbot
