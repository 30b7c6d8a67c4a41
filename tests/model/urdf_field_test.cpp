// URDF as other tools and people write it: what is no trouble, and what is refused by name because
// it would change the motion and is not simulated.
#include <gmock/gmock.h>

#include "tests/model/edited_robot.hpp"

namespace ballbot {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kLimit3 = "<limit lower=\"0\" upper=\"2.6\" effort=\"40\" velocity=\"12\"/>";

/// Same masses, same geometry.
void expectSameRobot(const RobotParameters& a, const RobotParameters& b) {
  EXPECT_EQ(a.base.mass, b.base.mass);
  EXPECT_EQ(a.base.I_LLcm_L, b.base.I_LLcm_L);
  for (int i = 0; i < kArmJointCount; ++i) {
    EXPECT_EQ(a.arm[i].inertia.I_LLcm_L, b.arm[i].inertia.I_LLcm_L);
    EXPECT_EQ(a.arm[i].p_PJ_P, b.arm[i].p_PJ_P);
    EXPECT_EQ(a.arm[i].axis, b.arm[i].axis);
  }
}

class FieldUrdf : public EditedRobot {
 protected:
  /// Replaces the limits of the third joint by other elements.
  void replaceLimit(const std::string& xml) { editUrdf("arm_3_joint", kLimit3, xml); }
  void addToJoint(const std::string& xml) { replaceLimit(kLimit3 + xml); }
};

TEST_F(FieldUrdf, WhatIsNotMechanicsIsNoTrouble) {
  editUrdf("link name=\"base\"", "<visual name=\"motor_1\">",
           "<!-- CAD --><visual><geometry><mesh filename=\"package://robot/meshes/base.stl\" "
           "scale=\"0.001 0.001 0.001\"/></geometry><material name=\"\"/></visual>"
           "<collision><geometry><mesh filename=\"model://base.dae\"/></geometry></collision>"
           "<self_collision_checking><origin xyz=\"0 0 0\"/></self_collision_checking>"
           "<contact><lateral_friction value=\"1\"/></contact><visual name=\"motor_1\">");
  addToJoint("<calibration rising=\"0.3\"/>");
  addToUrdf(
      "<transmission name=\"t\"><type>transmission_interface/SimpleTransmission</type>"
      "<joint name=\"arm_3_joint\"/><actuator name=\"m\"/></transmission>"
      "<gazebo reference=\"base\"><mu1>0.9</mu1></gazebo><gazebo><plugin filename=\"p.so\"/>"
      "</gazebo><ros2_control name=\"s\" type=\"system\"/><mujoco/><material name=\"x\"/>");
  expectSameRobot(read(), exampleRobot());
}

TEST_F(FieldUrdf, FixedJointsMayCarryWhatExportersWrite) {
  editUrdf("imu_joint", "<origin xyz=\"0.05 0 0.30\"/>",
           "<origin xyz=\"0.05 0 0.30\" rpy=\"0 0 0\"/><axis xyz=\"0 0 0\"/><limit lower=\"0\" "
           "upper=\"0\" effort=\"0\" velocity=\"0\"/><dynamics damping=\"1\" friction=\"1\"/>"
           "<safety_controller k_velocity=\"0\"/><mimic joint=\"arm_1_joint\"/>");
  expectSameRobot(read(), exampleRobot());
}

TEST_F(FieldUrdf, AnyWhiteSpaceSeparatesNumbers) {
  editUrdf("link name=\"arm_2\"", "xyz=\"0 0 0.225\"", "xyz=\"\t0\n  +0\r\n 0.225 \"");
  expectSameRobot(read(), exampleRobot());
}

TEST_F(FieldUrdf, ProductsOfInertiaThatAreLeftOutAreZero) {
  editUrdf("link name=\"arm_2\"", " ixy=\"0\" ixz=\"0\"", "");
  expectSameRobot(read(), exampleRobot());
}

TEST_F(FieldUrdf, SpeechlessDrivesAgreeWithAny) {
  replaceLimit(
      "<limit lower=\"0\" upper=\"2.6\" effort=\"1e7\" velocity=\"inf\"/>"
      "<dynamics damping=\"0\" friction=\"0.0\"/>");
  expectSameRobot(read(), exampleRobot());
}

TEST_F(FieldUrdf, DynamicsThatAreSimulatedAreWelcome) {
  addToJoint("<dynamics damping=\"0.3\" friction=\"0.65\"/>");
  expectSameRobot(read(), exampleRobot());
}

TEST_F(FieldUrdf, LimitsOfTheDrivesMayBeStricterThanTheUrdf) {
  replaceLimit("<limit lower=\"0\" upper=\"2.6\" effort=\"1000\" velocity=\"100\"/>");
  expectSameRobot(read(), exampleRobot());
}

/// An edit of the third arm joint or of a number, and the words that must be said about it.
struct Refusal {
  const char* name;
  const char* anchor;
  std::string from, to;
  const char* words;
};

class RefusedUrdf : public FieldUrdf, public ::testing::WithParamInterface<Refusal> {};

TEST_P(RefusedUrdf, IsRefusedByName) {
  editUrdf(GetParam().anchor, GetParam().from, GetParam().to);
  EXPECT_THAT(error(), HasSubstr(GetParam().words));
}

const std::string kLimit = kLimit3;
const std::string kMass = "<mass value=\"16.98\"/>";
const std::string kCom = "<origin xyz=\"0 0 0.225\"/>";

INSTANTIATE_TEST_SUITE_P(
    NotSimulated, RefusedUrdf,
    ::testing::Values(
        Refusal{"Effort", "arm_3_joint", "effort=\"40\"", "effort=\"2\"",
                "ballbot.urdf:383: joint 'arm_3_joint' has effort [N m] = 2, but "
                "series_elastic_actuator.yaml:11:17: peak_torque_Nm is 40, and that is what is "
                "simulated. Make it no more than the URDF allows, or change the URDF"},
        Refusal{"EffortOfAWheel", "wheel_2_joint", "effort=\"40\"", "effort=\"39\"",
                "joint 'wheel_2_joint' has effort [N m] = 39"},
        Refusal{"Velocity", "arm_3_joint", "velocity=\"12\"", "velocity=\"0.3\"",
                "velocity [rad/s] = 0.3, but series_elastic_actuator.yaml:12:24: "
                "speed_limit_rad_per_s is 12"},
        Refusal{"Damping", "arm_3_joint", kLimit, kLimit + "<dynamics damping=\"50\"/>",
                "damping [N m s/rad] = 50, but series_elastic_actuator.yaml:6:31: "
                "viscous_friction_Nms_per_rad is 0.3"},
        Refusal{"Friction", "arm_3_joint", kLimit, kLimit + "<dynamics friction=\"20\"/>",
                "friction [N m] = 20, but series_elastic_actuator.yaml:8:21: static_friction_Nm"},
        Refusal{"BallDamping", "ball_joint", "<child link=\"ball\"/>",
                "<child link=\"ball\"/><dynamics damping=\"1\"/>", "the ball rolls without <dyn"},
        Refusal{"Mimic", "arm_3_joint", kLimit, kLimit + "<mimic joint=\"arm_2_joint\"/>",
                "ballbot.urdf:388: <mimic> of joint 'arm_3_joint': joints that follow others are "
                "not simulated"},
        Refusal{"SoftLimits", "arm_3_joint", kLimit,
                kLimit + "<safety_controller k_velocity=\"10\" soft_lower_limit=\"1.9\"/>",
                "<safety_controller> of joint 'arm_3_joint': soft limits are not simulated"},
        Refusal{"Jerk", "arm_3_joint", "velocity=\"12\"", "velocity=\"12\" acceleration=\"3\"",
                "<limit> of joint 'arm_3_joint': acceleration would be ignored; known here: "},
        Refusal{"Floating", "arm_3_joint", "revolute", "floating", "is floating, must be revolute"},
        Refusal{"Planar", "arm_3_joint", "revolute", "planar", "is planar, must be revolute"},
        Refusal{"ZeroAxis", "arm_3_joint", "xyz=\"0 1 0\"", "xyz=\"0 0 0\"",
                "<axis> of joint 'arm_3_joint': xyz is zero, must be a direction"},
        Refusal{"NoLimit", "arm_3_joint", kLimit, "",
                "ballbot.urdf:383: <joint> 'arm_3_joint': has no <limit>"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Written, RefusedUrdf,
    ::testing::Values(
        Refusal{"TwoNumbersOfThree", "", kCom, "<origin xyz=\"0 0.225\"/>",
                "ballbot.urdf:285: <origin> of link 'arm_2': xyz is \"0 0.225\", must be 3 "
                "numbers"},
        Refusal{"Xacro", "", kMass, "<mass value=\"${base_mass}\"/>",
                "ballbot.urdf:25: <mass> of link 'base': value is \"${base_mass}\", must be a "
                "number: this is xacro, not yet a URDF; expand it"},
        Refusal{"XacroElement", "", "<link name=\"base\">", "<xacro:arm/><link name=\"base\">",
                "<xacro:arm>: this is xacro, not yet a URDF"},
        Refusal{"CommaDecimal", "", kMass, "<mass value=\"16,98\"/>",
                "value is \"16,98\", must be a number, with decimal points and without commas"},
        Refusal{"Infinite", "", kMass, "<mass value=\"inf\"/>", "must be a number"},
        Refusal{"NotANumber", "arm_3_joint", "upper=\"2.6\"", "upper=\"nan\"", "must be a number"},
        Refusal{"NegativeMass", "", kMass, "<mass value=\"-1\"/>", "must not be negative"},
        Refusal{"MomentLeftOut", "link name=\"arm_2\"", "ixx=\"0.01933\"", "",
                "<inertia> of link 'arm_2': has no ixx"},
        Refusal{"MisspeltAttribute", "arm_3_joint", "upper=", "uper=", "did you mean upper?"},
        Refusal{"MisspeltElement", "", "<link name=\"imu\">", "<link name=\"imu\"><inerial/>",
                "<inerial> of link 'imu': would be ignored; did you mean <inertial>?"},
        Refusal{"MassOutsideInertial", "", "<link name=\"imu\">",
                "<link name=\"imu\"><mass value=\"1\"/>", "put it in <inertial>"},
        Refusal{"NewerRotation", "", kCom, "<origin xyz=\"0 0 0.225\" quat_xyzw=\"0 0 0 1\"/>",
                "quat_xyzw would be ignored; known here: rpy, xyz"},
        Refusal{"Twice", "arm_3_joint", kLimit, kLimit + kLimit, "is there twice"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace ballbot
