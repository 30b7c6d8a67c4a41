// Somebody else's file of the same robot: other frames, other names, and the same run.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/model/turned_urdf.hpp"
#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

std::string renamed(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at; (at = text.find('"' + from + '"')) != std::string::npos;) {
    text.replace(at, from.size() + 2, '"' + to + '"');
  }
  return text;
}

TEST(OwnRobot, RunsAsTheOneItIsWithOtherFramesAndNames) {
  const TemporaryFolder folder;
  TurnedUrdf turned(readFile(BALLBOT_SOURCE_DIR "/configs/robots/ballbot.urdf"));
  int k = 0;
  for (const char* link : {"ball", "wheel_1", "wheel_2", "wheel_3", "arm_1", "arm_2", "arm_3"}) {
    ++k;
    turned.turn(link, rotationFromYawPitchRoll(0.7 * k, -0.3 * k, 1.1 * k));
  }
  std::string text = renamed(renamed(turned.text(), "base", "chassis"), "arm_2", "upper_arm");
  text = renamed(renamed(text, "wheel_3_joint", "omni_c"), "ball", "sphere");
  const std::string urdf = folder / "own.urdf";
  std::ofstream(urdf) << text;

  // Without what counts steps: a count that falls on the other side is another run.
  const std::vector<std::string> common = {"duration_s=6", "requirements={}",
                                           "plant.fidelity.sensors=perfect"};
  auto changes = common;
  changes.push_back("robot.urdf=" + urdf);
  changes.emplace_back("robot.links={base: chassis, arm_2: upper_arm, ball: sphere}");
  const auto plain_run = summaryOf({"push", common});
  const auto own_run = summaryOf({"push", changes, 1, folder / "own", true});
  EXPECT_TRUE(plain_run["passed"].get<bool>() && own_run["passed"].get<bool>());
  const auto plain = plain_run["metrics"], own = own_run["metrics"];
  for (const char* name : {"largest_tilt_deg", "largest_ball_excursion_m", "tilt_rms_deg",
                           "rms_wheel_torque_error_Nm", "largest_push_excursion_m"}) {
    EXPECT_NEAR(own[name].get<double>(), plain[name].get<double>(),
                1e-8 * std::abs(plain[name].get<double>()))
        << name;
  }
  // What is drawn has the file's names.
  const std::string report = readFile(folder / "own/report.html");
  for (const char* name : {"chassis", "sphere", "omni_c"}) EXPECT_THAT(report, HasSubstr(name));
}

/// The shipped robot with its shoulder made a lift: its second arm joint slides upwards.
void writeLift(const std::string& path) {
  std::string urdf = readFile(BALLBOT_SOURCE_DIR "/configs/robots/ballbot.urdf");
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = urdf.find(from, urdf.find("<joint name=\"arm_2_joint\""));
    ASSERT_NE(at, std::string::npos) << from;
    urdf.replace(at, from.size(), to);
  };
  replace("revolute", "prismatic");
  replace("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 1\"/>");
  replace("lower=\"-2.0\" upper=\"2.0\" effort=\"40\" velocity=\"12\"",
          "lower=\"-0.05\" upper=\"0.3\" effort=\"2000\" velocity=\"0.24\"");
  std::ofstream(path) << urdf;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

/// Of a table as exported, the last number of a column.
double lastOf(const std::string& path, const std::string& column) {
  std::istringstream text(readFile(path));
  std::string head, line, last;
  std::getline(text, head);
  while (std::getline(text, line)) last = line;
  const std::vector<std::string> names = cells(head), values = cells(last);
  for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) {
    if (names[i].rfind(column, 0) == 0) return std::stod(values[i]);
  }
  ADD_FAILURE() << path << " has no " << column;
  return 0;
}

// With the weights of the shipped robot, at full fidelity: pushed, and asked to lift its hand.
TEST(OwnRobot, BalancesWithAnArmThatSlides) {
  const TemporaryFolder folder;
  const std::string urdf = folder / "lift.urdf";
  writeLift(urdf);
  const std::string lift = "robot.nominal_arm_rad=[0, 5, 1.5707963267948966]";
  const auto pushed = summaryOf({"push", {"robot.urdf=" + urdf, lift, "duration_s=11"}, 2});
  ASSERT_FALSE(pushed.is_null());
  EXPECT_TRUE(pushed["passed"].get<bool>()) << pushed.dump(1);

  const std::string up = "{weight: 20, reference: {moves: [{at_s: 2, by: [0, 2, 0], over_s: 1}]}}";
  const auto lifted = summaryOf(
      {"balance",
       {"robot.urdf=" + urdf, lift, "duration_s=7", "controller.mpc.tasks.arm_position=" + up},
       1,
       folder / "lifted"});
  ASSERT_FALSE(lifted.is_null());
  EXPECT_TRUE(lifted["passed"].get<bool>()) << lifted.dump(1);
  ASSERT_EQ(runBallbot({"export", folder / "lifted", "--csv", folder / "csv"}).exit_code, 0);
  EXPECT_NEAR(lastOf(folder / "csv/truth.csv", "arm_angle_arm2"), 7, 0.1);
}

}  // namespace
}  // namespace ballbot
