#include <stdexcept>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "plant/plant_config.hpp"
#include "support/described_keys.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const KeyEntry& entryOf(const std::vector<KeyEntry>& entries, const std::string& path) {
  for (const KeyEntry& e : entries) {
    if (e.path == path) return e;
  }
  throw std::runtime_error("no entry " + path);
}

TEST(DescribePlant, TellsEveryKeyOfTheFilesThatShip) {
  const auto plant = described("plant", describePlant);
  const auto initial = described("initial", describeInitial);
  const auto environment = described("environment", describeEnvironment);
  const auto sensors = described("sensors", describeSensors);
  for (const std::string& file : shipped("plants")) {
    const ConfigNode tree = loadYamlFile(file);
    EXPECT_THAT(undescribed(&tree, "plant", plant), IsEmpty()) << file;
  }
  for (const std::string& file : shipped("scenarios")) {
    const ConfigNode tree = loadYamlFile(file);
    EXPECT_THAT(undescribed(tree.find("plant"), "plant", plant), IsEmpty()) << file;
    EXPECT_THAT(undescribed(tree.find("initial"), "initial", initial), IsEmpty()) << file;
    EXPECT_THAT(undescribed(tree.find("environment"), "environment", environment), IsEmpty())
        << file;
  }
  const ConfigNode robot = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/robots/ballbot.yaml");
  EXPECT_THAT(undescribed(robot.find("sensors"), "sensors", sensors), IsEmpty());
  EXPECT_FALSE(undescribed(robot.find("sensors"), "sensors", plant).empty());
}

TEST(DescribePlant, TellsEachKeyInWordsAndWithItsDefault) {
  expectWellDescribed(described("plant", describePlant));
  expectWellDescribed(described("initial", describeInitial));
  expectWellDescribed(described("environment", describeEnvironment));
  expectWellDescribed(described("robot.sensors", describeSensors));
}

TEST(DescribePlant, TellsWhatIsOftenNotThere) {
  const auto plant = described("plant", describePlant);
  EXPECT_EQ(entryOf(plant, "plant.motion_capture.yaw_noise_deg").kind, KeyKind::kNumber);
  EXPECT_EQ(entryOf(plant, "plant.compliant_contact.tolerance").fallback, "1e-06");
  EXPECT_EQ(entryOf(plant, "plant.wheel_loop_insertion.gain").fallback, "1");
  EXPECT_TRUE(entryOf(plant, "plant.spin_friction.patches.0.torque_Nm").required);
  EXPECT_FALSE(entryOf(plant, "plant.spin_friction").required);
  const auto environment = described("environment", describeEnvironment);
  EXPECT_EQ(entryOf(environment, "environment.wall.height_m").fallback, "2");
  EXPECT_EQ(entryOf(environment, "environment.door.opens").choices.size(), 2U);
}

// A listing has the keys of every kind; a reader wants those of the kind that is there.
TEST(DescribePlant, TellsTheKeysOfEveryKindOfFaultAndReadsThoseOfOne) {
  const auto plant = described("plant", describePlant);
  EXPECT_FALSE(entryOf(plant, "plant.faults.0.joint").required);
  EXPECT_FALSE(entryOf(plant, "plant.faults.0.signal").required);
  EXPECT_EQ(entryOf(plant, "plant.faults.0.traction_Nm").fallback, "0.2");

  const auto errorOf = [](const std::string& fault) -> std::string {
    try {
      plantConfig("full", {"plant.faults=[{start_s: 1, duration_s: 1, " + fault + "}]"});
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_EQ(errorOf("kind: imu_gap"), "none");
  EXPECT_THAT(errorOf("kind: imu_gap, share: 1"), HasSubstr("unknown key 'share'"));
  EXPECT_THAT(errorOf("kind: encoder_stuck"), HasSubstr("key 'joint' is missing"));
  EXPECT_THAT(errorOf("kind: spikes"), HasSubstr("key 'signal' is missing"));
  EXPECT_THAT(errorOf("kind: spikes, signal: gyro, joint: arm_1"),
              HasSubstr("unknown key 'joint'"));
  EXPECT_THAT(errorOf("kind: spikes, signal: joint_angle"), HasSubstr("key 'joint' is missing"));
  EXPECT_EQ(errorOf("kind: spikes, signal: joint_angle, joint: arm_1, share: 1"), "none");
  EXPECT_THAT(errorOf("kind: wheel_slip, joint: arm_1"),
              HasSubstr("must be one of: wheel_1, wheel_2, wheel_3"));
}

}  // namespace
}  // namespace ballbot
