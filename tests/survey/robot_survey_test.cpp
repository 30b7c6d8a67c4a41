#include "survey/robot_survey.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/angle.hpp"
#include "model/omniwheel_kinematics.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Without wheels to spin, a robot that leans for good is one rigid body on a ball that rolls.
TEST(Leaning, IsARigidBodyOnABall) {
  RobotParameters robot = exampleRobot();
  robot.wheels.spin_inertia = 1e-12;
  robot.nominal_arm.setZero();  // upright: the centre of mass is above the ball at rest
  const ReducedDynamics dynamics(robot);
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  const RobotSurvey survey = surveyRobot(robot);
  const double m = survey.mass_on_ball, l = survey.height, r = robot.ball.radius;
  for (const double angle : {0.02, 0.1, 0.4}) {
    for (const double heading : {0.0, 1.0, 2.5}) {
      const Lean lean = leanSteadily(dynamics, rest, angle, heading);
      // Moments about the contact: gravity, against all that has the acceleration a.
      const double mass =
          m * (l * std::cos(angle) + r) + robot.ball.mass * r + robot.ball.inertia / r;
      // Pitch and roll together lean by this.
      const double pitch = angle * std::cos(heading), roll = angle * std::sin(heading);
      const double tilt = std::acos(std::cos(pitch) * std::cos(roll));
      EXPECT_NEAR(lean.acceleration, m * robot.gravity * l * std::sin(tilt) / mass,
                  (heading == 0 ? 1e-9 : 0.02) * lean.acceleration);
    }
  }
  EXPECT_NEAR(leanSteadily(dynamics, rest, 0, 0).acceleration, 0, 1e-9);
}

TEST(Leaning, TorqueIsWhatTheDynamicsNeed) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  const Lean lean = leanSteadily(dynamics, rest, 0.1, 0);
  EXPECT_GT(lean.acceleration, 0);
  EXPECT_NEAR(lean.floor_friction, lean.acceleration / robot.gravity, 1e-3);
  EXPECT_LT(lean.wheel_torque, robot.wheel_torque_limit);
}

TEST(Leaning, TopSpeedIsThatOfTheFirstWheel) {
  const RobotParameters robot = exampleRobot();
  const double speed = topSpeed(robot, 12);
  const OmniwheelKinematics kinematics(robot);
  double fastest = 0;
  for (int i = 0; i < 360; ++i) {
    const double heading = i * kRadPerDeg;
    const Vector3 ball = OmniwheelKinematics::rollingAngularVelocity(
        speed * std::cos(heading), speed * std::sin(heading), robot.ball.radius);
    fastest = std::max(fastest, kinematics.wheelRates(ball, Vector3::Zero()).cwiseAbs().maxCoeff());
  }
  EXPECT_NEAR(fastest, 12, 1e-9);
}

TEST(RobotSurvey, OfTheShippedRobot) {
  RobotParameters robot = exampleRobot();
  const RobotSurvey survey = surveyRobot(robot);
  EXPECT_NEAR(survey.mass, 25, 1e-9);
  EXPECT_NEAR(survey.mass_on_ball, 25 - robot.ball.mass, 1e-9);
  EXPECT_NEAR(survey.fall_rate, 5.2, 0.05);  // docs/theory/loop.md
  EXPECT_EQ(survey.workspace.unbalanced, 0);
  // Between one and another of its poses:
  EXPECT_LE(survey.workspace.least_fall_rate, survey.fall_rate);
  EXPECT_GE(survey.workspace.largest_fall_rate, survey.fall_rate);
  EXPECT_LE(survey.steepest.wheel_torque, robot.wheel_torque_limit * (1 + 1e-9));
  EXPECT_THAT(survey.warnings, IsEmpty());
}

TEST(RobotSurvey, SaysWhatCannotBe) {
  RobotParameters robot = exampleRobot();
  robot.arm[2].inertia.mass = 40;  // falls over with its arm, where that is level
  robot.wheel_torque_limit = 0.2;
  robot.arm_torque_limit = 5;
  const auto warnings = surveyRobot(robot).warnings;
  ASSERT_GE(warnings.size(), 3u);
  EXPECT_THAT(warnings[0], HasSubstr("poses of the arm leave no balance within 30 degrees"));
  EXPECT_THAT(warnings[1], HasSubstr("joint 'arm_2' needs up to"));
  EXPECT_THAT(warnings.back(), HasSubstr("any push is too much"));
}

}  // namespace
}  // namespace ballbot
