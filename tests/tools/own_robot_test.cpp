// Somebody else's file of the same robot: other frames, other names, and the same run.
#include <fstream>
#include <sstream>
#include <string>

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

}  // namespace
}  // namespace ballbot
