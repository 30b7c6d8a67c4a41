#include "controller/solver_settings.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

FrequencyShaping readShaping(ConfigReader& in) {
  FrequencyShaping out;
  ConfigReading reading(in);
  describe(reading, out);
  in.finish();
  return out;
}

TEST(ShapingSettings, AreMatchedToAnActuatorsBandwidth) {
  const ConfigNode tree = parseYaml("{actuator_bandwidth_Hz: 10}", "mpc.yaml");
  ConfigReader in(tree);
  const FrequencyShaping shaping = readShaping(in);
  EXPECT_NEAR(shaping.zero, 0.75 * 2 * M_PI * 10, 1e-9);
  EXPECT_NEAR(shaping.rho(), 15, 1e-12);
}

TEST(ShapingSettings, RefuseTwoWaysOfSayingIt) {
  const ConfigNode tree = parseYaml("{actuator_bandwidth_Hz: 10, zero_rad_per_s: 100}", "mpc.yaml");
  ConfigReader in(tree);
  try {
    readShaping(in);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("must be the one or the other"));
  }
}

TEST(ShapingSettings, RefuseAPoleBelowTheZero) {
  const ConfigNode tree = parseYaml("{zero_rad_per_s: 100, pole_rad_per_s: 50}", "mpc.yaml");
  ConfigReader in(tree);
  try {
    readShaping(in);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("pole_rad_per_s is 50, must be between 100"));
  }
}

TEST(HorizonSettings, RefuseALengthThatIsNoWholeNumberOfSteps) {
  const ConfigNode tree = parseYaml("{length_s: 1, step_ms: 30}", "mpc.yaml");
  ConfigReader in(tree);
  Horizon horizon;
  ConfigReading reading(in);
  describe(reading, horizon);
  try {
    requireWholeSteps(in, horizon);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("length_s leaves 33.3333 steps of 30 ms"));
  }
}

}  // namespace
}  // namespace ballbot
