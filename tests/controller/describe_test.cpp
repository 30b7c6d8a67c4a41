#include <filesystem>
#include <map>
#include <set>

#include <gmock/gmock.h>

#include "controller/controller_settings.hpp"
#include "core/config_listing.hpp"
#include "core/yaml_file.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<KeyEntry> listed() {
  ConfigListing listing("controller");
  describeController(listing, exampleRobot());
  return listing.take();
}

std::map<std::string, KeyEntry> byPath() {
  std::map<std::string, KeyEntry> out;
  for (const KeyEntry& e : listed()) out[e.path] = e;
  return out;
}

/// Every key below `node`, items of lists being all called 0.
void collect(const ConfigNode& node, const std::string& path, std::set<std::string>& out) {
  for (const auto& [key, value] : node.entries()) {
    out.insert(path + "." + key);
    collect(value, path + "." + key, out);
  }
  for (const ConfigNode& item : node.items()) collect(item, path + ".0", out);
}

std::set<std::string> keysOfShippedFiles() {
  std::set<std::string> out;
  const std::string configs = BALLBOT_SOURCE_DIR "/configs/";
  for (const char* folder : {"controllers", "scenarios"}) {
    for (const auto& file : std::filesystem::directory_iterator(configs + folder)) {
      const ConfigNode tree = loadYamlFile(file.path().string());
      const ConfigNode* controller =
          folder == std::string("scenarios") ? tree.find("controller") : &tree;
      if (controller) collect(*controller, "controller", out);
    }
  }
  return out;
}

TEST(DescribeController, ListsEveryKeyOfTheShippedFiles) {
  const auto keys = byPath();
  const std::set<std::string> used = keysOfShippedFiles();
  ASSERT_GT(used.size(), 60U);
  for (const std::string& path : used) EXPECT_EQ(keys.count(path), 1U) << path;
}

TEST(DescribeController, ListsNoKeyTwice) { EXPECT_EQ(byPath().size(), listed().size()); }

TEST(DescribeController, HasWordsForEveryKeyAndADefaultForEveryOneThatMayBeLeftOut) {
  const std::set<KeyKind> without_default = {KeyKind::kSection, KeyKind::kList, KeyKind::kOther};
  for (const KeyEntry& e : listed()) {
    EXPECT_GE(e.words.size(), 8U) << e.path;
    EXPECT_NE(e.words.back(), '.') << e.path;
    EXPECT_FALSE(std::isupper(static_cast<unsigned char>(e.words[0])) &&
                 std::islower(static_cast<unsigned char>(e.words[1])))
        << e.path << ": " << e.words;
    if (!e.required && without_default.count(e.kind) == 0) {
      EXPECT_THAT(e.fallback, Not(IsEmpty())) << e.path;
    }
  }
}

TEST(DescribeController, TakesDefaultsFromTheRobot) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 0.25;
  robot.wheel_torque_limit = 6.5;
  ConfigListing listing("controller");
  describeController(listing, robot);
  std::map<std::string, std::string> fallback;
  for (const KeyEntry& e : listing.take()) fallback[e.path] = e.fallback;
  EXPECT_EQ(fallback["controller.known_payload_kg"], "0.25");
  EXPECT_EQ(fallback["controller.tracker.wheel_torque_limit_Nm"], "6.5");
  EXPECT_EQ(fallback["controller.tracker.arm_stiffness_Nm_per_rad"], "8");
  EXPECT_EQ(fallback["controller.mpc.horizon.step_ms"], "20");
  EXPECT_EQ(fallback["controller.mpc.fallback_after_ms"], "100");
  EXPECT_EQ(fallback["controller.mpc.constraints.wheel_rate_limits.share_of_limit"], "0.7");
  EXPECT_EQ(fallback["controller.mpc.terminal.kind"], "scaled_state");
  EXPECT_EQ(fallback["controller.lqr.set_point.ball_position_m"], "[0, 0]");
}

TEST(DescribeController, DemandsOfAMoveOnlyItsTime) {
  const auto keys = byPath();
  const std::string move = "controller.mpc.tasks.ball_position.reference.moves.0.";
  EXPECT_TRUE(keys.at(move + "at_s").required);
  for (const char* key : {"by", "over_s", "circle_radius_m", "period_s", "turns"}) {
    EXPECT_FALSE(keys.at(move + key).required) << key;
  }
  EXPECT_THAT(typeText(keys.at(move + "by")), HasSubstr("list of 2"));
}

}  // namespace
}  // namespace ballbot
