#include "model/urdf_loader.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

/// A copy of the example robot's folder in which texts can be replaced.
class EditedRobot : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("ballbot_urdf_" + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    const fs::path source = fs::path(robotFile()).parent_path();
    for (const auto& entry : fs::directory_iterator(source)) {
      fs::copy(entry.path(), folder_ / entry.path().filename(),
               fs::copy_options::overwrite_existing);
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Replaces the first `from` after `anchor`.
  void edit(const std::string& file, const std::string& anchor, const std::string& from,
            const std::string& to) {
    std::stringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    std::string s = text.str();
    const std::size_t start = s.find(anchor);
    ASSERT_NE(start, std::string::npos) << anchor;
    const std::size_t at = s.find(from, start);
    ASSERT_NE(at, std::string::npos) << from;
    s.replace(at, from.size(), to);
    std::ofstream(folder_ / file) << s;
  }
  void editUrdf(const std::string& anchor, const std::string& from, const std::string& to) {
    edit("ballbot.urdf", anchor, from, to);
  }

  RobotParameters read() const {
    const ConfigNode tree = loadYamlFile((folder_ / "ballbot.yaml").string());
    ConfigReader in(tree, "robot");
    return readRobot(in);
  }

  /// The error with the folder cut off.
  std::string error() const {
    try {
      read();
    } catch (const InputError& e) {
      std::string text = e.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = text.find(prefix)) != std::string::npos;)
        text.erase(at, prefix.size());
      return text;
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(EditedRobot, IsReadUnchanged) {
  const RobotParameters robot = read();
  EXPECT_EQ(robot.name, "ballbot");
  EXPECT_EQ(robot.ball.radius, 0.125);
  EXPECT_EQ(robot.arm[1].axis, Vector3::UnitY());
  EXPECT_EQ(robot.arm[2].upper_limit, 2.6);
  EXPECT_EQ(robot.p_BI_B, Vector3(0.05, 0, 0.30));
  EXPECT_LT((robot.R_A3E - rotationFromYawPitchRoll(0, -M_PI / 2, 0)).norm(), 1e-15);
  EXPECT_EQ(robot.wheel_torque_limit, 4);
}

TEST_F(EditedRobot, UrdfIsSoughtBesideTheFileThatNamesIt) {
  std::ofstream(folder_ / "scenario.yaml")
      << "robot: {include: ballbot.yaml, payload_mass_kg: 1}\n";
  const ConfigNode tree = loadYamlFile((folder_ / "scenario.yaml").string());
  ConfigReader in(tree);
  ConfigReader robot = in.child("robot");
  EXPECT_NEAR(readRobot(robot).totalMass(), 26, 1e-12);
}

TEST(UrdfPath, IsRelativeToWhereItWasWritten) {
  const auto path = [](const char* value, const char* source) {
    return urdfPath(ConfigNode::scalar(value, false, {source, 1, 1}));
  };
  EXPECT_EQ(path("robot.urdf", "configs/robots/robot.yaml"), "configs/robots/robot.urdf");
  EXPECT_EQ(path("../robot.urdf", "configs/robots/robot.yaml"), "configs/robot.urdf");
  EXPECT_EQ(path("robot.urdf", "robot.yaml"), "robot.urdf");
  EXPECT_EQ(path("/robots/robot.urdf", "configs/robots/robot.yaml"), "/robots/robot.urdf");
  EXPECT_EQ(path("my/robot.urdf", "--set robot.urdf=my/robot.urdf"), "my/robot.urdf");
}

TEST_F(EditedRobot, MissingFileIsNamed) {
  edit("ballbot.yaml", "", "ballbot.urdf", "nowhere.urdf");
  EXPECT_EQ(error(), "nowhere.urdf: cannot be read");
}

TEST_F(EditedRobot, BrokenXmlIsNamed) {
  editUrdf("", "</robot>", "");
  EXPECT_THAT(error(), HasSubstr("ballbot.urdf: is not a valid URDF: "));
}

TEST_F(EditedRobot, MissingLinkIsNamed) {
  editUrdf("", "link name=\"imu\"", "link name=\"gyro\"");
  editUrdf("", "child link=\"imu\"", "child link=\"gyro\"");
  EXPECT_THAT(error(),
              HasSubstr("ballbot.urdf: link 'imu' is missing; the robot needs the links base"));
}

TEST_F(EditedRobot, JointToAMissingLinkIsNamed) {
  editUrdf("arm_2_joint", "child link=\"arm_2\"", "child link=\"arm_two\"");
  EXPECT_THAT(error(),
              AllOf(HasSubstr("ballbot.urdf: is not a valid URDF: "), HasSubstr("arm_two")));
}

TEST_F(EditedRobot, UnknownJointTypeIsNamed) {
  editUrdf("arm_3_joint", "revolute", "rotary");
  EXPECT_THAT(error(), AllOf(HasSubstr("ballbot.urdf: is not a valid URDF: "),
                             HasSubstr("arm_3_joint"), HasSubstr("rotary")));
}

TEST_F(EditedRobot, UnsuitableJointTypeIsNamed) {
  editUrdf("arm_2_joint", "revolute", "prismatic");
  EXPECT_EQ(error(),
            "ballbot.urdf: joint 'arm_2_joint' of link 'arm_2' is prismatic, must be revolute");
}

TEST_F(EditedRobot, WrongParentIsNamed) {
  editUrdf("arm_3_joint", "parent link=\"arm_2\"", "parent link=\"arm_1\"");
  EXPECT_EQ(error(), "ballbot.urdf: link 'arm_3' must hang on 'arm_2', but hangs on 'arm_1'");
}

TEST_F(EditedRobot, IndefiniteInertiaIsNamed) {
  editUrdf("link name=\"arm_2\"", "iyy=\"0.01915\"", "iyy=\"-0.01915\"");
  EXPECT_EQ(error(),
            "ballbot.urdf: link 'arm_2': inertia is not positive definite; its principal moments "
            "are -0.01915, 0.00156, 0.01933 kg m^2");
}

TEST_F(EditedRobot, InertiaOfNoRigidBodyIsNamed) {
  editUrdf("link name=\"arm_3\"", "iyy=\"0.01680\"", "iyy=\"0.01\"");
  EXPECT_EQ(error(),
            "ballbot.urdf: link 'arm_3': no rigid body has this inertia: of its principal moments "
            "0.00058, 0.01, 0.0168 kg m^2 the largest exceeds the sum of the others");
}

TEST_F(EditedRobot, ZeroMassIsNamed) {
  editUrdf("link name=\"arm_1\"", "mass value=\"1.30\"", "mass value=\"0\"");
  EXPECT_EQ(error(), "ballbot.urdf: link 'arm_1': mass is 0 kg, must be more than 0");
}

TEST_F(EditedRobot, MissingInertiaIsNamed) {
  editUrdf("link name=\"wheel_2\"", "<inertial>", "<!--");
  editUrdf("link name=\"wheel_2\"", "</inertial>", "-->");
  EXPECT_EQ(error(), "ballbot.urdf: link 'wheel_2' has no <inertial> with a mass");
}

TEST_F(EditedRobot, UnequalWheelIsNamed) {
  editUrdf("link name=\"wheel_3\"", "mass value=\"0.56\"", "mass value=\"0.6\"");
  EXPECT_EQ(error(), "ballbot.urdf: link 'wheel_3' must have the mass and inertia of 'wheel_1'");
}

TEST_F(EditedRobot, WrongTotalMassIsNamed) {
  editUrdf("link name=\"base\"", "mass value=\"16.98\"", "mass value=\"17.98\"");
  EXPECT_EQ(error(),
            "ballbot.yaml:3:16: total_mass_kg is 25, but the links of ballbot.urdf sum to 26 kg");
}

TEST_F(EditedRobot, WheelGeometryMustAgreeWithTheYaml) {
  edit("ballbot.yaml", "wheels:", "contact_zenith_deg: 45", "contact_zenith_deg: 40");
  EXPECT_THAT(error(), HasSubstr("wheels contradicts the URDF: link 'wheel_1' is at (0.133643, "
                                 "0.000000, 0.133643)"));
}

TEST_F(EditedRobot, NominalArmMustBeWithinTheLimits) {
  edit("ballbot.yaml", "nominal_arm_rad", "-0.6", "-2.5");
  EXPECT_THAT(error(),
              HasSubstr("nominal_arm_rad puts joint 2 at -2.5 rad, must be between -2 and 2 "
                        "(link 'arm_2' of ballbot.urdf)"));
}

TEST_F(EditedRobot, FixedPartCountsToItsBody) {
  editUrdf("", "</robot>",
           "<link name=\"camera\"><inertial><mass value=\"0.5\"/><inertia ixx=\"1e-4\" ixy=\"0\" "
           "ixz=\"0\" iyy=\"2e-4\" iyz=\"0\" izz=\"2e-4\"/></inertial></link>"
           "<joint name=\"camera_joint\" type=\"fixed\"><parent link=\"base\"/><child "
           "link=\"camera\"/><origin xyz=\"0.1 0 0.4\" rpy=\"0 0 "
           "1.5707963267948966\"/></joint></robot>");
  edit("ballbot.yaml", "", "total_mass_kg: 25.0", "total_mass_kg: 25.5");
  const BodyInertia bare = exampleRobot().base, with_camera = read().base;
  EXPECT_NEAR(with_camera.mass, bare.mass + 0.5, 1e-12);
  const Vector3 added = with_camera.mass * with_camera.p_LLcm_L - bare.mass * bare.p_LLcm_L;
  EXPECT_LT((added - 0.5 * Vector3(0.1, 0, 0.4)).norm(), 1e-12);
}

TEST_F(EditedRobot, PartOnAMovingJointIsRefused) {
  editUrdf("", "</robot>",
           "<link name=\"flag\"/><joint name=\"flag_joint\" type=\"continuous\"><parent "
           "link=\"base\"/><child link=\"flag\"/></joint></robot>");
  EXPECT_EQ(error(),
            "ballbot.urdf: link 'flag' hangs on joint 'flag_joint' of type continuous; only ball, "
            "wheels and arm move, so it must be fixed");
}

}  // namespace
}  // namespace ballbot
