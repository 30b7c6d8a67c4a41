#include "experiment/run_metrics.hpp"

#include <algorithm>

#include <gmock/gmock.h>

#include "model/reduced_dynamics.hpp"

namespace ballbot {
namespace {

using ::testing::Contains;

class RunMetricsTest : public ::testing::Test {
 protected:
  RunMetricsTest()
      : config_(readRunConfig(
            loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/ee_pose_tracking.yaml"))),
        metrics_(config_) {
    truth_.state = findEquilibrium(ReducedDynamics(config_.robot), config_.robot.nominal_arm).x;
    const auto tip = ReducedDynamics(config_.robot).endEffector(truth_.state);
    truth_.p_WE = tip.p_WE;
    truth_.quat_WE << 1, 0, 0, 0;
  }

  void addUntil(double end_s) {
    for (; toSeconds(truth_.time) < end_s; truth_.time += std::chrono::milliseconds(10)) {
      const std::optional<TruthFrame> truth = truth_;
      metrics_.add({0, truth_.time, sensors_, truth, control_, 0});
    }
  }

  RunConfig config_;
  RunMetrics metrics_;
  SensorFrame sensors_;
  TruthFrame truth_;
  ControlOutput control_;
};

TEST_F(RunMetricsTest, HaveNoNameThatIsNotOnTheList) {
  control_.has_estimate = true;
  addUntil(40);
  const std::vector<std::string> names = RunMetrics::names();
  for (const auto& [name, value] : metrics_.values()) EXPECT_THAT(names, Contains(name)) << value;
  EXPECT_FALSE(metrics_.fell());
}

TEST_F(RunMetricsTest, ARobotThatStandsStillMissesTheStepsItWasAskedFor) {
  addUntil(toSeconds(config_.scenario.duration - SimDuration(0)));
  // 0.3 m along x, then along y, and the hand stayed where it was.
  EXPECT_NEAR(metrics_.values().at("ee_position_error_m"), 0.3, 0.01);
  EXPECT_EQ(metrics_.values().count("ee_x_rise_s"), 0u) << "90 % were never reached";
}

TEST_F(RunMetricsTest, SeeAFall) {
  addUntil(3);
  truth_.state[kPitch] = 1.2;
  addUntil(3.2);
  EXPECT_TRUE(metrics_.fell());
}

TEST_F(RunMetricsTest, WithoutTruthNothingIsMeasured) {
  const std::optional<TruthFrame> unknown;
  metrics_.add({0, kSimStart, sensors_, unknown, control_, 0});
  EXPECT_EQ(metrics_.values().count("largest_tilt_deg"), 0u);
}

}  // namespace
}  // namespace ballbot
