#include "model/urdf_loader.hpp"

#include <gmock/gmock.h>

#include "model/frames.hpp"
#include "model/limits.hpp"
#include "model/robot_urdf.hpp"
#include "tests/model/edited_robot.hpp"

namespace ballbot {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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

TEST_F(EditedRobot, BrokenXmlIsNamedWithItsLine) {
  editUrdf("arm_2_joint", "<parent link=\"arm_1\"/>", "<parent link=\"arm_1\">");
  EXPECT_THAT(error(), HasSubstr("ballbot.urdf:330: is not well-formed XML: mismatched element"));
}

TEST_F(EditedRobot, OtherXmlIsNamed) {
  editUrdf("", "<robot name=\"ballbot\">", "<sdf>");
  editUrdf("", "</robot>", "</sdf>");
  EXPECT_EQ(error(), "ballbot.urdf:13: is no URDF: its root is <sdf>, must be <robot>");
}

TEST_F(EditedRobot, MissingLinkIsNamed) {
  editUrdf("", "link name=\"imu\"", "link name=\"gyro\"");
  editUrdf("", "child link=\"imu\"", "child link=\"gyro\"");
  EXPECT_THAT(error(),
              HasSubstr("ballbot.urdf: link 'imu' is missing; the robot needs the links base"));
}

TEST_F(EditedRobot, JointToAMissingLinkIsNamed) {
  editUrdf("arm_2_joint", "child link=\"arm_2\"", "child link=\"arm_two\"");
  EXPECT_EQ(error(),
            "ballbot.urdf:329: joint 'arm_2_joint' names the link 'arm_two', which is not in the "
            "file");
}

TEST_F(EditedRobot, UnknownJointTypeIsNamed) {
  editUrdf("arm_3_joint", "revolute", "rotary");
  EXPECT_EQ(error(),
            "ballbot.urdf:383: <joint> 'arm_3_joint': type is 'rotary', must be one of: revolute, "
            "continuous, prismatic, fixed, floating, planar");
}

TEST_F(EditedRobot, UnsuitableJointTypeIsNamed) {
  editUrdf("arm_2_joint", "revolute", "planar");
  EXPECT_EQ(error(),
            "ballbot.urdf:329: joint 'arm_2_joint' of link 'arm_2' is planar, must be revolute, "
            "continuous or prismatic");
}

TEST_F(EditedRobot, WhatSlidesCountsByTheAngleOfItsDrive) {
  const std::string limit = "lower=\"-2.0\" upper=\"2.0\" effort=\"40\" velocity=\"12\"";
  editUrdf("arm_2_joint", "revolute", "prismatic");
  editUrdf("arm_2_joint", limit, "lower=\"-0.1\" upper=\"0.3\" effort=\"800\" velocity=\"0.6\"");
  edit("ballbot.yaml", "", "payload_mass_kg: 0", "slide_lead_m_per_rad: 0.05\npayload_mass_kg: 0");
  const RobotParameters robot = read();
  EXPECT_TRUE(robot.arm[1].slides());
  EXPECT_FALSE(robot.arm[0].slides());
  EXPECT_EQ(robot.arm[1].lead, 0.05);
  EXPECT_EQ(robot.arm[1].lower_limit, -0.1 / 0.05);
  EXPECT_EQ(robot.arm[1].upper_limit, 0.3 / 0.05);
  edit("ballbot.yaml", "", "slide_lead_m_per_rad: 0.05", "slide_lead_m_per_rad: 0.02");
  EXPECT_THAT(error(), AllOf(HasSubstr("joint 'arm_2_joint', at 0.02 m per rad of its drive, has "
                                       "effort [N m] = 16, but"),
                             HasSubstr("peak_torque_Nm is 40")));
}

TEST_F(EditedRobot, WhatSlidesHasAnEnd) {
  editUrdf("arm_2_joint", "revolute", "prismatic");
  editUrdf("arm_2_joint", "<limit lower=\"-2.0\" upper=\"2.0\" effort=\"40\" velocity=\"12\"/>",
           "");
  EXPECT_THAT(error(), HasSubstr("has no <limit>, which a prismatic joint must have"));
}

TEST_F(EditedRobot, WrongParentIsNamed) {
  editUrdf("arm_3_joint", "parent link=\"arm_2\"", "parent link=\"arm_1\"");
  EXPECT_EQ(error(), "ballbot.urdf:383: link 'arm_3' must hang on 'arm_2', but hangs on 'arm_1'");
}

TEST_F(EditedRobot, WhatIsNoTreeIsNamed) {
  addToUrdf(
      "<joint name=\"again\" type=\"fixed\"><parent link=\"base\"/><child link=\"arm_2\"/>"
      "</joint>");
  EXPECT_THAT(error(), HasSubstr("link 'arm_2' hangs on joint 'arm_2_joint' already (line 329), so "
                                 "'again' would close a loop"));
}

TEST_F(EditedRobot, ALoopAsideIsNamed) {
  addToUrdf(partXml("a", "b", 1, 1) + partXml("b", "a", 1, 1));
  EXPECT_THAT(error(), HasSubstr("link 'a' is in a loop of joints; the robot must be a tree"));
}

TEST_F(EditedRobot, ALooseLinkIsNamed) {
  addToUrdf("<link name=\"tool\"/>");
  EXPECT_THAT(error(), HasSubstr("links 'base' and 'tool' both hang on no joint"));
}

TEST_F(EditedRobot, ASecondLinkOfANameIsNamed) {
  addToUrdf("<link name=\"arm_1\"/>");
  EXPECT_THAT(error(), HasSubstr("a second link has the name 'arm_1'; the first is in line 249"));
}

TEST_F(EditedRobot, NegativeMomentIsNamed) {
  editUrdf("link name=\"arm_2\"", "iyy=\"0.01915\"", "iyy=\"-0.01915\"");
  EXPECT_EQ(error(),
            "ballbot.urdf:287: <inertia> of link 'arm_2': iyy is -0.01915 kg m^2, must not be "
            "negative");
}

TEST_F(EditedRobot, IndefiniteInertiaIsNamed) {
  editUrdf("link name=\"arm_2\"", "ixy=\"0\"", "ixy=\"0.03\"");
  EXPECT_THAT(error(),
              HasSubstr("ballbot.urdf:283: link 'arm_2': inertia is not positive definite; "
                        "its principal moments are -0.01"));
}

TEST_F(EditedRobot, InertiaOfNoRigidBodyIsNamed) {
  editUrdf("link name=\"arm_3\"", "iyy=\"0.01680\"", "iyy=\"0.01\"");
  EXPECT_EQ(error(),
            "ballbot.urdf:337: link 'arm_3': no rigid body has this inertia: of its principal "
            "moments 0.00058, 0.01, 0.0168 kg m^2 the largest exceeds the sum of the others");
}

TEST_F(EditedRobot, ABodyWithoutMassIsNamed) {
  editUrdf("link name=\"wheel_2\"", "<inertial>", "<!--");
  editUrdf("link name=\"wheel_2\"", "</inertial>", "-->");
  EXPECT_THAT(error(), HasSubstr("link 'wheel_2' has no mass, must have some"));
}

TEST_F(EditedRobot, InertiaWithoutMassIsNamed) {
  editUrdf("link name=\"arm_1\"", "mass value=\"1.30\"", "mass value=\"0\"");
  EXPECT_EQ(error(),
            "ballbot.urdf:253: <inertia> of link 'arm_1': is not zero, but the mass is; a body "
            "without mass has no inertia");
}

TEST_F(EditedRobot, UnequalWheelIsNamed) {
  editUrdf("link name=\"wheel_3\"", "mass value=\"0.56\"", "mass value=\"0.6\"");
  EXPECT_THAT(error(), HasSubstr("link 'wheel_3' must have the mass and inertia of 'wheel_1'"));
}

TEST_F(EditedRobot, TheBallsSphereMustBeItsOnlyOneAndInTheMiddle) {
  editUrdf("link name=\"ball\"", "<collision name=\"sphere\">",
           "<collision name=\"sphere\"><origin xyz=\"0 0 0.01\"/>");
  EXPECT_THAT(error(), HasSubstr("link 'ball': the sphere must have its centre at the link's"));
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

TEST_F(EditedRobot, AnArmOfAnotherSizeNamesTheBuild) {
  edit("ballbot.yaml", "nominal_arm_rad", "[0,", "[0, 0,");
  EXPECT_THAT(error(),
              AllOf(HasSubstr("nominal_arm_rad has 4 values, but this program is built for "
                              "arms of 3 joints"),
                    HasSubstr("cmake -DBALLBOT_ARM_JOINTS=4")));
}

TEST_F(EditedRobot, NominalArmMustBeWithinTheLimits) {
  edit("ballbot.yaml", "nominal_arm_rad", "-0.6", "-2.5");
  EXPECT_THAT(error(),
              HasSubstr("nominal_arm_rad puts joint 2 at -2.5 rad, must be between -2 and 2 "
                        "(link 'arm_2' of ballbot.urdf)"));
}

TEST_F(EditedRobot, WheelsNeedDirectionsOfTheirOwn) {
  edit("ballbot.yaml", "azimuth_deg", "[0, 120, 240]", "[0, 120, 360]");
  EXPECT_THAT(error(), HasSubstr("azimuth_deg puts wheels 1 and 3 0 degrees apart, must be at "
                                 "least 5"));
}

TEST_F(EditedRobot, WithoutGravityThereIsNothingToBalance) {
  edit("ballbot.yaml", "", "gravity_m_per_s2: 9.81", "gravity_m_per_s2: 0");
  EXPECT_THAT(error(), HasSubstr("gravity_m_per_s2 is 0, must be between 0.1 and 100"));
}

TEST_F(EditedRobot, FixedPartCountsToItsBody) {
  addToUrdf(partXml("camera", "base", 0.5, 1e-4, "fixed", "0.1 0 0.4"));
  setTotalMass("25.5");
  const BodyInertia bare = exampleRobot().base, with_camera = read().base;
  EXPECT_NEAR(with_camera.mass, bare.mass + 0.5, 1e-12);
  const Vector3 added = with_camera.mass * with_camera.p_LLcm_L - bare.mass * bare.p_LLcm_L;
  EXPECT_LT((added - 0.5 * Vector3(0.1, 0, 0.4)).norm(), 1e-12);
}

TEST_F(EditedRobot, WhatHangsOnAFrameCountsToTheBodyOfTheFrame) {
  // Frames of the last link and the base, and a part on a part, turned on the way.
  addToUrdf(partXml("gripper", "end_effector", 2, 1e-3, "fixed", "0.05 0 0") +
            partXml("finger", "gripper", 0.25, 1e-4, "fixed", "0 0.02 0") +
            partXml("shield", "imu", 0.5, 1e-4));
  setTotalMass("27.75");
  const RobotParameters bare = exampleRobot(), robot = read();
  EXPECT_NEAR(robot.arm[2].inertia.mass, bare.arm[2].inertia.mass + 2.25, 1e-12);
  EXPECT_NEAR(robot.base.mass, bare.base.mass + 0.5, 1e-12);
  // E has its x along the link's z.
  const auto moment = [](const BodyInertia& b) -> Vector3 { return b.mass * b.p_LLcm_L; };
  const Vector3 gripper(0, 0, 0.4), finger(0, 0.02, 0.4);
  EXPECT_LT(
      (moment(robot.arm[2].inertia) - moment(bare.arm[2].inertia) - 2 * gripper - 0.25 * finger)
          .norm(),
      1e-12);
}

TEST_F(EditedRobot, AFrameMayHaveMassItself) {
  editUrdf("", "<link name=\"end_effector\">",
           "<link name=\"end_effector\"><inertial><mass value=\"1\"/><inertia ixx=\"1e-4\" "
           "iyy=\"1e-4\" izz=\"1e-4\"/></inertial>");
  setTotalMass("26");
  EXPECT_NEAR(read().arm[2].inertia.mass, exampleRobot().arm[2].inertia.mass + 1, 1e-12);
}

TEST_F(EditedRobot, FramesAndPointMassesAreParts) {
  addToUrdf(partXml("tcp", "arm_3", 0, 0) + partXml("marker", "arm_3", 0.2, 0));
  setTotalMass("25.2");
  EXPECT_NEAR(read().arm[2].inertia.mass, exampleRobot().arm[2].inertia.mass + 0.2, 1e-12);
}

TEST_F(EditedRobot, AFrameChangesNoBit) {
  addToUrdf(partXml("tcp", "base", 0, 0, "fixed", "0.1 0.2 0.3"));
  EXPECT_EQ(read().base.p_LLcm_L, exampleRobot().base.p_LLcm_L);
  EXPECT_EQ(read().base.I_LLcm_L, exampleRobot().base.I_LLcm_L);
}

TEST_F(EditedRobot, TheWholeOfABodyIsChecked) {
  // The sum of both is no rigid body's, though the camera may be one.
  editUrdf("link name=\"arm_2\"", "ixx=\"0.01933\"", "ixx=\"0.5\"");
  addToUrdf(partXml("camera", "arm_2", 0.1, 1e-5));
  EXPECT_THAT(error(), HasSubstr("link 'arm_2' with all that is fixed to it: no rigid body has"));
}

TEST_F(EditedRobot, PartOnAMovingJointIsRefused) {
  for (const char* parent : {"base", "end_effector"}) {
    SetUp();
    addToUrdf(partXml("flag", parent, 0.1, 1e-5, "continuous"));
    EXPECT_THAT(error(),
                HasSubstr("link 'flag' hangs on joint 'flag_joint' of type continuous; "
                          "only ball, wheels and the 3 joints of the arm that this program "
                          "is built for move, so it must be fixed"));
  }
}

TEST_F(EditedRobot, ALimitOutOfReachIsNone) {
  for (const char* limit : {"1000001", "1e16", "1.7976931348623157e+308", "inf"}) {
    SetUp();
    editUrdf("arm_2_joint", "lower=\"-2.0\" upper=\"2.0\"",
             std::string("lower=\"-") + limit + "\" upper=\"" + limit + "\"");
    EXPECT_EQ(read().arm[1].lower_limit, -kUnlimited) << limit;
    EXPECT_EQ(read().arm[1].upper_limit, kUnlimited) << limit;
  }
}

TEST_F(EditedRobot, AContinuousArmJointHasNoLimits) {
  editUrdf("arm_1_joint", "revolute", "continuous");
  EXPECT_EQ(read().arm[0].lower_limit, -kUnlimited);
  EXPECT_EQ(read().arm[0].upper_limit, kUnlimited);
}

TEST_F(EditedRobot, ATorqueLimitOutOfReachIsNone) {
  edit("ballbot.yaml", "", "arm_torque_limit_Nm: 18", "arm_torque_limit_Nm: 1e308");
  EXPECT_EQ(read().arm_torque_limit, kUnlimited);
}

TEST_F(EditedRobot, LimitsInDegreesDeserveAWord) {
  const auto notes = [this] {
    return readRobotUrdf(loadYamlFile((folder_ / "ballbot.yaml").string())).read.notes;
  };
  EXPECT_TRUE(notes().empty());
  editUrdf("arm_1_joint", "lower=\"-3.1\" upper=\"3.1\"", "lower=\"-177.6\" upper=\"177.6\"");
  ASSERT_EQ(notes().size(), 1u);
  EXPECT_THAT(notes()[0], HasSubstr("joint 'arm_1_joint' has a limit at -177.6 rad, -28.3 turns "
                                    "away. URDF counts in rad: -177.6 degrees would be -3.1"));
}

}  // namespace
}  // namespace ballbot
