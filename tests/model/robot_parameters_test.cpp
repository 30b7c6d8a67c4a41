#include "model/robot_parameters.hpp"

#include <gtest/gtest.h>

#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

TEST(RobotParameters, BaseWithWheelsGivesThePublishedBody) {
  const BodyInertia body = exampleRobot().baseWithWheels();
  EXPECT_NEAR(body.mass, 18.66, 1e-12);
  EXPECT_LT((body.p_LLcm_L - Vector3(0, 0, 0.1956)).norm(), 1e-12);
  const Matrix3 expected = Vector3(1.086, 1.090, 0.167).asDiagonal();
  EXPECT_LT((body.I_LLcm_L - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RobotParameters, WeighsTwentyFiveKilograms) {
  RobotParameters robot = exampleRobot();
  EXPECT_NEAR(robot.totalMass(), 25, 1e-12);
  robot.payload_mass = 2;
  EXPECT_NEAR(robot.totalMass(), 27, 1e-12);
}

TEST(RobotParameters, WheelsTouchTheBallAndAreDrivenAcrossTheContact) {
  const RobotParameters robot = exampleRobot();
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 c = robot.contactDirection(i), d = robot.wheelAxle(i);
    EXPECT_NEAR(c.norm(), 1, 1e-15);
    EXPECT_NEAR(d.norm(), 1, 1e-15);
    EXPECT_NEAR(c.dot(d), 0, 1e-15);
    EXPECT_GT(c.z(), 0);
    EXPECT_LT(d.z(), 0);
    EXPECT_NEAR(robot.wheelCentre(i).norm(), robot.ball.radius + robot.wheels.radius, 1e-15);
  }
}

TEST(BodyInertia, OfTwoPointsIsThatOfADumbbell) {
  BodyInertia left, right;
  left.mass = 1;
  left.p_LLcm_L = Vector3(-1, 0, 0);
  right.mass = 3;
  const BodyInertia both = composed(left, right, Vector3(1, 0, 0));
  EXPECT_EQ(both.mass, 4);
  EXPECT_LT((both.p_LLcm_L - Vector3(0.5, 0, 0)).norm(), 1e-15);
  const Matrix3 expected = Vector3(0, 3, 3).asDiagonal();  // reduced mass 3/4, length 2
  EXPECT_LT((both.I_LLcm_L - expected).norm(), 1e-15);
}

TEST(RobotParameters, PayloadSitsAtTheEndEffector) {
  RobotParameters robot = exampleRobot();
  const BodyInertia bare = robot.lastLinkWithPayload();
  EXPECT_EQ(bare.mass, robot.arm.back().inertia.mass);
  EXPECT_EQ(bare.I_LLcm_L, robot.arm.back().inertia.I_LLcm_L);
  robot.payload_mass = 1;
  const BodyInertia loaded = robot.lastLinkWithPayload();
  const Vector3 first_moment = loaded.mass * loaded.p_LLcm_L - bare.mass * bare.p_LLcm_L;
  EXPECT_LT((first_moment - robot.p_A3E).norm(), 1e-15);
}

}  // namespace
}  // namespace ballbot
