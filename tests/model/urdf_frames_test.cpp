// Where a file puts its frames and what it calls its links is its own affair: the robot is the
// same.
#include <random>

#include <gmock/gmock.h>

#include "model/reduced_dynamics.hpp"
#include "tests/model/edited_robot.hpp"
#include "tests/model/turned_urdf.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

class UrdfFrames : public EditedRobot {
 protected:
  std::string urdf() const {
    std::stringstream text;
    text << std::ifstream(folder_ / "ballbot.urdf").rdbuf();
    return text.str();
  }
  void setUrdf(const std::string& text) { std::ofstream(folder_ / "ballbot.urdf") << text; }
  void addKeys(const std::string& yaml) {
    std::ofstream(folder_ / "ballbot.yaml", std::ios::app) << '\n' << yaml << '\n';
  }
};

void expectSameBody(const BodyInertia& a, const BodyInertia& b) {
  EXPECT_NEAR(a.mass, b.mass, 1e-12);
  EXPECT_LT((a.p_LLcm_L - b.p_LLcm_L).norm(), 1e-12);
  EXPECT_LT((a.I_LLcm_L - b.I_LLcm_L).norm(), 1e-12);
}

/// But for how E itself is turned.
void expectSameMotion(const RobotParameters& a, const RobotParameters& b) {
  expectSameBody(a.base, b.base);
  EXPECT_LT((a.p_BI_B - b.p_BI_B).norm(), 1e-12);
  EXPECT_LT((a.p_A3E - b.p_A3E).norm(), 1e-12);
  for (int i = 0; i < kArmJointCount; ++i) {
    SCOPED_TRACE(i);
    expectSameBody(a.arm[i].inertia, b.arm[i].inertia);
    EXPECT_LT((a.arm[i].p_PJ_P - b.arm[i].p_PJ_P).norm(), 1e-12);
    EXPECT_LT((a.arm[i].axis - b.arm[i].axis).norm(), 1e-12);
  }
}

Matrix3 anyRotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

class TurnedFrames : public UrdfFrames, public ::testing::WithParamInterface<unsigned> {};

TEST_P(TurnedFrames, AreTheSameRobot) {
  std::mt19937 random(GetParam());
  const RobotParameters plain = exampleRobot();
  const std::string original = urdf();
  Matrix3 R_E;
  {
    TurnedUrdf turned(original);
    for (const char* link :
         {"arm_1", "arm_2", "arm_3", "wheel_1", "wheel_2", "wheel_3", "ball", "imu"}) {
      turned.turn(link, anyRotation(random));
    }
    R_E = anyRotation(random);
    turned.turn("end_effector", R_E);
    setUrdf(turned.text());
  }
  const RobotParameters robot = read();
  expectSameMotion(robot, plain);
  EXPECT_LT((robot.R_A3E - plain.R_A3E * R_E).norm(), 1e-12);

  // And so the same motion, from any state, to ten digits.
  const ReducedDynamics there(robot), here(plain);
  std::uniform_real_distribution<double> value(-1, 1);
  StateVector x;
  JointVector tau;
  for (double& v : x.reshaped()) v = value(random);
  for (double& v : tau.reshaped()) v = value(random);
  const Vector3 force(value(random), value(random), value(random));
  const StateVector expected = here.derivative(x, tau, force);
  EXPECT_LT((there.derivative(x, tau, force) - expected).norm(), 1e-10 * expected.norm());
}
INSTANTIATE_TEST_SUITE_P(Of, TurnedFrames, ::testing::Range(1U, 31U));

TEST_F(UrdfFrames, AQuarterTurnAsExportersWriteIt) {
  // The elbow's axis is its z, as Denavit and Hartenberg have it.
  editUrdf("arm_3_joint", "<origin xyz=\"0 0 0.30\"/>",
           "<origin xyz=\"0 0 0.30\" rpy=\"-1.5707963267948966 0 0\"/>");
  editUrdf("arm_3_joint", "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 1\"/>");
  editUrdf("link name=\"arm_3\"", "<origin xyz=\"0 0 0.221\"/>", "<origin xyz=\"0 -0.221 0\"/>");
  editUrdf("link name=\"arm_3\"", "iyy=\"0.01680\"", "iyy=\"0.00058\"");
  editUrdf("link name=\"arm_3\"", "izz=\"0.00058\"", "izz=\"0.01680\"");
  editUrdf("end_effector_joint", "<origin xyz=\"0 0 0.35\" rpy=\"0 -1.5707963267948966 0\"/>",
           "<origin xyz=\"0 -0.35 0\" rpy=\"1.5707963267948966 0 -1.5707963267948966\"/>");
  expectSameMotion(read(), exampleRobot());
  EXPECT_LT((read().R_A3E - exampleRobot().R_A3E).norm(), 1e-12);
}

TEST_F(UrdfFrames, FixedLinksMayBeBetween) {
  // Flanges of their own, turned, that carry the elbow, a wheel, the IMU and the end-effector.
  const std::string flange = "<origin xyz=\"0 0 0.1\" rpy=\"0 0 1.5707963267948966\"/>";
  const auto add = [&](const std::string& name, const std::string& parent) {
    addToUrdf("<link name=\"" + name + "\"/><joint name=\"" + name +
              "_joint\" type=\"fixed\"><parent link=\"" + parent + "\"/><child link=\"" + name +
              "\"/>" + flange + "</joint>");
  };
  add("elbow_flange", "arm_2");
  add("board", "base");
  add("board_2", "board");
  editUrdf("arm_3_joint", "parent link=\"arm_2\"", "parent link=\"elbow_flange\"");
  editUrdf("arm_3_joint", "<origin xyz=\"0 0 0.30\"/>",
           "<origin xyz=\"0 0 0.20\" rpy=\"0 0 -1.5707963267948966\"/>");
  editUrdf("imu_joint", "parent link=\"base\"", "parent link=\"board_2\"");
  editUrdf("imu_joint", "xyz=\"0.05 0 0.30\"", "xyz=\"-0.05 0 0.10\"");  // half a turn on
  expectSameMotion(read(), exampleRobot());
}

TEST_F(UrdfFrames, WhatIsFixedToATurnedLinkIsWeighedWhereItIs) {
  const double mass = 0.5;
  addToUrdf(partXml("camera", "arm_2", mass, 1e-4, "fixed", "0.1 0.02 0.3"));
  setTotalMass("25.5");
  const RobotParameters plain = read();
  TurnedUrdf turned(urdf());
  turned.turn("arm_2", rotationFromYawPitchRoll(0.3, -1.2, 2));
  setUrdf(turned.text());
  expectSameMotion(read(), plain);
}

TEST_F(UrdfFrames, LinksAreCalledWhatTheFileCallsThem) {
  std::string text = urdf();
  for (const auto& [from, to] :
       {std::pair<const char*, const char*>{"\"base\"", "\"chassis_link\""},
        {"\"arm_2\"", "\"ns/upper arm\""},
        {"\"wheel_1\"", "\"omni_front\""},
        {"\"imu\"", "\"board_link\""}}) {
    for (std::size_t at; (at = text.find(from)) != std::string::npos;) {
      text.replace(at, std::string(from).size(), to);
    }
  }
  setUrdf(text);
  EXPECT_THAT(error(), HasSubstr("link 'base' is missing; the robot needs the links base, ball, "
                                 "wheel_1, wheel_2, wheel_3, arm_1, arm_2, arm_3, end_effector, "
                                 "imu, or other names for them in robot.links"));
  addKeys("links: {base: chassis_link, arm_2: ns/upper arm, wheel_1: omni_front, imu: board_link}");
  expectSameMotion(read(), exampleRobot());
  EXPECT_EQ(read().arm[1].name, "ns/upper arm");
  editUrdf("arm_3_joint", "parent link=\"ns/upper arm\"", "parent link=\"chassis_link\"");
  EXPECT_EQ(error(),
            "ballbot.urdf:383: link 'arm_3' must hang on 'ns/upper arm', but hangs on "
            "'chassis_link'");
}

TEST_F(UrdfFrames, ANameForTwoPartsIsRefused) {
  addKeys("links: {arm_2: arm_1}");
  EXPECT_THAT(error(), HasSubstr("links: 'arm_1' stands for two parts of the robot, must be one"));
}

}  // namespace
}  // namespace ballbot
