#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

const std::string kRobot = BALLBOT_SOURCE_DIR "/configs/robots/ballbot.yaml";
const std::string kUrdf = BALLBOT_SOURCE_DIR "/configs/robots/ballbot.urdf";

TEST(RobotCommand, TellsOfADescriptionAndOfAUrdfAloneTheSame) {
  const Finished yaml = runBallbot({"robot", kRobot, "--json"});
  ASSERT_EQ(yaml.exit_code, 0) << yaml.err;
  const Finished urdf = runBallbot({"robot", kUrdf, "--like", kRobot, "--set",
                                    "nominal_arm_rad=[0, -0.6, 2.1707963267948966]", "--set",
                                    "wheel_torque_limit_Nm=4", "--json"});
  ASSERT_EQ(urdf.exit_code, 0) << urdf.err;
  const auto a = nlohmann::json::parse(yaml.out), b = nlohmann::json::parse(urdf.out);
  EXPECT_NEAR(a["fall_rate_per_s"].get<double>(), b["fall_rate_per_s"].get<double>(), 1e-9);
  EXPECT_NEAR(a["steepest"]["lean_deg"].get<double>(), b["steepest"]["lean_deg"].get<double>(),
              1e-6);
  EXPECT_NEAR(a["top_speed_m_per_s"].get<double>(), b["top_speed_m_per_s"].get<double>(), 1e-6);
}

TEST(RobotCommand, WritesADescriptionOnceAndItIsReadBack) {
  const TemporaryFolder folder;
  const std::string file = folder / "own.yaml";
  EXPECT_EQ(runBallbot({"robot", kUrdf, "--like", kRobot, "--new", file}).exit_code, 0);
  const Finished read = runBallbot({"robot", file});
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, HasSubstr("over 729 poses of the arm, of which 0 leave no balance"));
  const std::string before = readFile(file);
  const Finished again = runBallbot({"robot", kUrdf, "--like", kRobot, "--new", file});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("is there already, and nothing is overwritten"));
  EXPECT_EQ(readFile(file), before);
}

TEST(RobotCommand, BadInputIsBadInput) {
  const auto errorOf = [](const std::vector<std::string>& arguments) {
    const Finished run = runBallbot(arguments);
    EXPECT_EQ(run.exit_code, 2);
    return run.err;
  };
  EXPECT_THAT(errorOf({"robot", "nothing.urdf"}), HasSubstr("there is no file 'nothing.urdf'"));
  EXPECT_THAT(errorOf({"robot", kUrdf, "--like", "no.yaml"}), HasSubstr("with --like"));
  EXPECT_THAT(errorOf({"robot", kRobot, "--new", "x.yaml"}), HasSubstr("from a URDF"));
  EXPECT_THAT(errorOf({"robot", kUrdf, "--like", kRobot, "--set", "links.base=chassis"}),
              HasSubstr("link 'chassis' is missing"));
  EXPECT_THAT(errorOf({"robot", kRobot, "--set", "nominal_arm_rad=[0, 9, 0]"}),
              HasSubstr("must be between -2 and 2"));
  EXPECT_THAT(errorOf({"robot", kRobot, "--set", "gravty=3"}), HasSubstr("gravity_m_per_s2"));
}

}  // namespace
}  // namespace ballbot
