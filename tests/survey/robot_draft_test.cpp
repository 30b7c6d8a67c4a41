#include "survey/robot_draft.hpp"

#include <gmock/gmock.h>

#include "core/config_reader.hpp"
#include "model/robot_reader.hpp"
#include "tests/model/edited_robot.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

class RobotDraftTest : public EditedRobot {
 protected:
  RobotDraft draft() const { return {(folder_ / "ballbot.urdf").string(), {}}; }
  RobotParameters drafted() const {
    const ConfigNode tree = draft().laidOn(loadYamlFile((folder_ / "ballbot.yaml").string()));
    ConfigReader in(tree, "robot");
    return readRobot(in);
  }
  std::string draftError() const {
    return errorOf([this] { draft(); });
  }
};

TEST_F(RobotDraftTest, FindsTheWheelsWhereTheyAre) {
  const RobotParameters own = drafted(), shipped = exampleRobot();
  EXPECT_NEAR(own.wheels.radius, shipped.wheels.radius, 1e-9);
  EXPECT_NEAR(own.wheels.contact_zenith, shipped.wheels.contact_zenith, 1e-9);
  for (int i = 0; i < kWheelCount; ++i) {
    EXPECT_LT((own.wheelCentre(i) - shipped.wheelCentre(i)).norm(), 1e-9);
  }
  EXPECT_NEAR(own.totalMass(), shipped.totalMass(), 1e-9);
}

TEST_F(RobotDraftTest, AsAFileIsTheSameRobot) {
  std::ofstream(folder_ / "own.yaml") << draft().text("ballbot.urdf", "ballbot.yaml");
  const ConfigNode tree = loadYamlFile((folder_ / "own.yaml").string());
  ConfigReader in(tree, "robot");
  const RobotParameters from_file = readRobot(in), own = drafted();
  EXPECT_EQ(from_file.wheel_torque_limit, own.wheel_torque_limit);
  EXPECT_EQ(from_file.wheel_speed_limit, own.wheel_speed_limit);
  EXPECT_EQ(from_file.nominal_arm, own.nominal_arm);
  EXPECT_EQ(from_file.wheels.azimuth, own.wheels.azimuth);
}

TEST_F(RobotDraftTest, DrivesKeepTheLimitsOfTheUrdf) {
  editUrdf("wheel_2_joint", "effort=\"40\" velocity=\"12\"", "effort=\"3\" velocity=\"8\"");
  editUrdf("arm_1_joint", "effort=\"40\"", "effort=\"0\"");  // nobody filled it in
  const RobotParameters own = drafted();
  EXPECT_EQ(own.wheel_torque_limit, 3);
  EXPECT_EQ(own.wheel_speed_limit, 8);
  EXPECT_EQ(own.arm_torque_limit, 40);
}

TEST_F(RobotDraftTest, WheelsThatNoDescriptionCanHaveAreNamed) {
  editUrdf("wheel_3_joint", "-0.11573839034650513", "-0.12573839034650513");
  EXPECT_THAT(draftError(),
              HasSubstr("link 'wheel_3' is 0.195284 m from the ball's centre at 46.8152 degrees"));
  editUrdf("wheel_1_joint", "xyz=\"0.13364318164425748 0 0.13364318164425748\"",
           "xyz=\"0.01 0 0.01\"");
  EXPECT_THAT(draftError(), HasSubstr("link 'wheel_1' is 0.01414 m from the ball's, inside the"));
}

}  // namespace
}  // namespace ballbot
