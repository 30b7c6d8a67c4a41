#include "estimator/estimator_factory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "tests/estimator/support/smooth_motion.hpp"

namespace ballbot::test {
namespace {

std::string messageFor(const std::string& yaml) {
  const ConfigNode tree = parseYaml(yaml, "est.yaml");
  ConfigReader in(tree);
  try {
    makeEstimator(in, estimatorTestRobot());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EstimatorFactory, MakesWhatTheShippedFilesName) {
  for (const char* name : {"complementary"}) {
    const ConfigNode tree =
        loadYamlFile(std::string(BALLBOT_SOURCE_DIR) + "/configs/estimators/" + name + ".yaml");
    ConfigReader in(tree);
    EXPECT_NE(makeEstimator(in, estimatorTestRobot()), nullptr) << name;
  }
}

TEST(EstimatorFactory, NamesUnknownKindsAndKeys) {
  EXPECT_THAT(messageFor("kind: kalman\n"), testing::HasSubstr("complementary"));
  EXPECT_THAT(messageFor("kind: complementary\ntilt_bandwith_rad_per_s: 1\n"),
              testing::AllOf(testing::HasSubstr("est.yaml:2"),
                             testing::HasSubstr("tilt_bandwidth_rad_per_s")));
  EXPECT_THAT(messageFor("kind: complementary\nalignment_samples: 0\n"),
              testing::HasSubstr("alignment_samples is 0"));
}

}  // namespace
}  // namespace ballbot::test
