#include "model/omniwheel_kinematics.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

const Vector3 kKappa(0.7, -1.1, 0.4), kOmega(-0.2, 0.5, 0.9);

TEST(OmniwheelKinematics, RatesInvertToTheBallsVelocity) {
  const OmniwheelKinematics wheels(exampleRobot());
  const Vector3 back = wheels.ballAngularVelocity(wheels.wheelRates(kKappa, kOmega), kOmega);
  EXPECT_LT((back - kKappa).norm(), 1e-14);
}

TEST(OmniwheelKinematics, TorquesInvert) {
  const OmniwheelKinematics wheels(exampleRobot());
  const Vector3 torque(1, -2, 0.5);
  EXPECT_LT((wheels.wheelTorques(wheels.ballTorque(torque)) - torque).norm(), 1e-14);
}

TEST(OmniwheelKinematics, PowerIsTheSameOnBothSides) {
  const OmniwheelKinematics wheels(exampleRobot());
  const Vector3 torque(1, -2, 0.5);
  const double motor_power = torque.dot(wheels.wheelRates(kKappa, kOmega));
  const double ball_power = wheels.ballTorque(torque).dot(kKappa - kOmega);
  EXPECT_NEAR(motor_power, ball_power, 1e-13);
}

TEST(OmniwheelKinematics, NothingSlipsAtTheContacts) {
  const RobotParameters robot = exampleRobot();
  const OmniwheelKinematics wheels(robot);
  const Vector3 rates = wheels.wheelRates(kKappa, kOmega);
  for (int i = 0; i < kWheelCount; ++i) {
    // Velocity of the wheel's and the ball's material point at contact i, along the driven tangent;
    // the rollers leave the other tangent free.
    const Vector3 c = robot.contactDirection(i), d = robot.wheelAxle(i);
    const Vector3 p_contact = robot.ball.radius * c;
    const Vector3 from_wheel = p_contact - robot.wheelCentre(i);
    const Vector3 v_wheel = kOmega.cross(p_contact) + (rates[i] * d).cross(from_wheel);
    const Vector3 v_ball = kKappa.cross(p_contact);
    EXPECT_NEAR((v_wheel - v_ball).dot(c.cross(d)), 0, 1e-15);
  }
}

TEST(OmniwheelKinematics, RowsAtRestPoseAreThoseOfTheTheory) {
  const OmniwheelKinematics wheels(exampleRobot());
  const auto rows = wheels.wheelRows(Matrix3::Identity());
  Eigen::Matrix<double, 3, 5> expected;
  expected << 0, 11.049, 1.381, 0, -1.381,    //
      -9.568, -5.524, -0.691, 1.196, -1.381,  //
      9.568, -5.524, -0.691, -1.196, -1.381;
  EXPECT_LE((rows.leftCols<5>() - expected).cwiseAbs().maxCoeff(), 0.51e-3);
  EXPECT_EQ((rows.rightCols<3>().norm()), 0);

  const Vector3 singular = Eigen::JacobiSVD<Eigen::MatrixXd>(rows).singularValues();
  EXPECT_LE((singular - Vector3(13.64, 13.64, 2.39)).cwiseAbs().maxCoeff(), 0.5e-2);
}

TEST(OmniwheelKinematics, RowsGiveTheRatesOfTheRollingBall) {
  const RobotParameters robot = exampleRobot();
  const OmniwheelKinematics wheels(robot);
  const Matrix3 R = rotationFromYawPitchRoll(0.4, -0.2, 0.3);
  VelocityVector nu;
  nu << 0.5, -0.3, kOmega, 1, 2, 3;
  const Vector3 kappa =
      R.transpose() * OmniwheelKinematics::rollingAngularVelocity(0.5, -0.3, robot.ball.radius);
  EXPECT_LT((wheels.wheelRows(R) * nu - wheels.wheelRates(kappa, kOmega)).norm(), 1e-14);
}

TEST(OmniwheelKinematics, TheBallsLowestPointRestsOnTheFloor) {
  const Vector3 w = OmniwheelKinematics::rollingAngularVelocity(0.5, -0.3, 0.125);
  const Vector3 v_floor = Vector3(0.5, -0.3, 0) + w.cross(Vector3(0, 0, -0.125));
  EXPECT_LT(v_floor.norm(), 1e-15);
  EXPECT_EQ(w.z(), 0);
}

}  // namespace
}  // namespace ballbot
