#include "experiment/robot_sensing.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

Scenario balance(const std::vector<std::string>& overrides) {
  return loadScenario(std::string(BALLBOT_SOURCE_DIR) + "/configs/scenarios/balance.yaml",
                      overrides);
}

std::string errorOf(const std::vector<std::string>& overrides) {
  try {
    RobotSensing sensing(readRunConfig(balance(overrides)));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(RobotSensing, RefusesAnImuOfWhichItWouldNotSeeEverySample) {
  EXPECT_EQ(
      errorOf({"robot.sensors.imu.period_ms=1"}),
      "--set robot.sensors.imu.period_ms=1: period_ms is 1 ms, but the estimator looks once in "
      "2.5 ms, and would never see 60 % of the samples. Set rates.estimator_period_us: 1000, "
      "or the IMU to a period of 2.5 ms or longer");
}

TEST(RobotSensing, TakesAnImuThatIsAsFastAsTheEstimatorOrSlower) {
  EXPECT_EQ(errorOf({}), "");
  EXPECT_EQ(errorOf({"robot.sensors.imu.period_ms=5"}), "");
  EXPECT_EQ(errorOf({"robot.sensors.imu.period_ms=1", "rates.estimator_period_us=1000"}), "");
}

}  // namespace
}  // namespace ballbot
