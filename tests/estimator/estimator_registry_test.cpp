#include "estimator/estimator_registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "estimator/two_state_settings.hpp"
#include "tests/estimator/support/smooth_motion.hpp"

namespace ballbot::test {
namespace {

std::string messageFor(const std::string& yaml) {
  const ConfigNode tree = parseYaml(yaml, "est.yaml");
  ConfigReader in(tree);
  try {
    readEstimator(in)->make(estimatorTestRobot());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EstimatorRegistry, MakesWhatTheShippedFilesName) {
  for (const char* name : {"complementary", "two_state"}) {
    const ConfigNode tree =
        loadYamlFile(std::string(BALLBOT_SOURCE_DIR) + "/configs/estimators/" + name + ".yaml");
    ConfigReader in(tree);
    EXPECT_NE(readEstimator(in)->make(estimatorTestRobot()), nullptr) << name;
  }
}

TEST(EstimatorRegistry, TheShippedTwoStateFileHoldsTheDefaults) {
  ConfigNode tree =
      loadYamlFile(std::string(BALLBOT_SOURCE_DIR) + "/configs/estimators/two_state.yaml");
  tree.erase("kind");
  ConfigReader in(tree);
  const TwoStateSettings read = TwoStateSettings::read(in), defaults;
  EXPECT_EQ(read.noise.wheel_increment, defaults.noise.wheel_increment);
  EXPECT_EQ(read.noise.gyro_density, defaults.noise.gyro_density);
  EXPECT_EQ(read.noise.accel_inflation, defaults.noise.accel_inflation);
  EXPECT_NEAR(read.initial.yaw, defaults.initial.yaw, 1e-6);
  EXPECT_NEAR(read.initial.tilt, defaults.initial.tilt, 1e-12);
  EXPECT_EQ(read.gate.wheel_gate_sigma, defaults.gate.wheel_gate_sigma);
  EXPECT_EQ(read.balance.moment_sigma, defaults.balance.moment_sigma);
  EXPECT_EQ(read.balance.momentum_sigma, defaults.balance.momentum_sigma);
  EXPECT_EQ(read.balance.window_s, defaults.balance.window_s);
  EXPECT_EQ(read.balance.push_chi_square, defaults.balance.push_chi_square);
  EXPECT_EQ(read.imu_wait, defaults.imu_wait);
  EXPECT_FALSE(read.use_external_pose);
}

TEST(EstimatorRegistry, NamesUnknownKindsAndKeys) {
  EXPECT_THAT(messageFor("kind: kalman\n"), testing::HasSubstr("complementary"));
  EXPECT_THAT(messageFor("kind: complementary\ntilt_bandwith_rad_per_s: 1\n"),
              testing::AllOf(testing::HasSubstr("est.yaml:2"),
                             testing::HasSubstr("tilt_bandwidth_rad_per_s")));
  EXPECT_THAT(messageFor("kind: two_state\niterations: 1\n"),
              testing::HasSubstr("iterations is 1"));
  EXPECT_THAT(messageFor("kind: two_state\nnoise:\n  gyro: 1\n"),
              testing::AllOf(testing::HasSubstr("est.yaml:3"),
                             testing::HasSubstr("unknown key 'gyro' in 'noise'")));
  EXPECT_THAT(messageFor("kind: complementary\nalignment_samples: 0\n"),
              testing::HasSubstr("alignment_samples is 0"));
}

}  // namespace
}  // namespace ballbot::test
