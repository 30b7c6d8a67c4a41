// Where a robot stands still under a force that its model does not know. Checked against the
// equations of motion, against a robot that has the mass in its hand in its model, and against
// statics by hand.
#include "controller/lasting_load.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

StateVector posed(double yaw, const Vector3& arm) {
  StateVector x = StateVector::Zero();
  x.segment<2>(kBallX) << 0.3, -0.7;
  x[kYaw] = yaw;
  x[kPitch] = 0.05;
  x[kRoll] = -0.02;
  x.segment<3>(kArm1) = arm;
  x.tail<kVelocityDim>().setConstant(0.1);  // is no part of it
  return x;
}

VelocityVector randomForce(int index) {
  const RandomCase c = randomCase(index);
  VelocityVector d = 0.5 * c.x.tail<kVelocityDim>();
  d.head<2>() *= 5;
  d.segment<3>(kOmegaX) *= 4;
  return d;
}

TEST(LastingLoad, NothingMovesThereUnderTheForce) {
  const ReducedDynamics dynamics(exampleRobot());
  const Vector3 arm = dynamics.robot().nominal_arm;
  for (int i = 0; i < 50; ++i) {
    const VelocityVector d = randomForce(i);
    const StateVector at = posed(0.3 * i, arm + 0.3 * randomCase(i).lambda / 20);
    LastingLoad load;
    ASSERT_TRUE(findLastingLoad(dynamics, at, d, load)) << i;
    const PositionVector q = load.x.head<kPositionDim>();
    // M dnu/dt = S^T tau + d - h, not by the way the acceleration was found.
    const VelocityVector unbalanced = dynamics.selectionMatrix(q).transpose() * load.torque + d -
                                      dynamics.nonlinearEffects(q, VelocityVector::Zero());
    EXPECT_LT(unbalanced.cwiseAbs().maxCoeff(), 1e-9) << i;
    EXPECT_LT((dynamics.massMatrix(q) * load.acceleration - d).cwiseAbs().maxCoeff(), 1e-9) << i;
    const StateVector rate = dynamics.derivative(load.x, load.torque, Vector3::Zero());
    EXPECT_LT((rate.tail<kVelocityDim>() + load.acceleration).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(load.x.tail<kVelocityDim>(), VelocityVector::Zero());
    EXPECT_EQ(load.x[kYaw], at[kYaw]);
    EXPECT_EQ(load.x.segment<3>(kArm1), at.segment<3>(kArm1));
    EXPECT_EQ(load.x.head<2>(), at.head<2>());
  }
}

TEST(LastingLoad, AMassInTheHandGivesTheRestOfARobotThatKnowsOfIt) {
  const RobotParameters robot = exampleRobot();
  RobotParameters loaded = robot;
  loaded.payload_mass = 2;
  const ReducedDynamics dynamics(robot), with_mass(loaded);
  const Equilibrium expected = findEquilibrium(with_mass, robot.nominal_arm);
  const PositionVector q = expected.x.head<kPositionDim>();
  // The weight as a force on the end-effector: J^T (0, 0, -m g).
  const VelocityVector d =
      dynamics.endEffectorJacobian(q).topRows<3>().transpose() * Vector3(0, 0, -2 * robot.gravity);
  LastingLoad load;
  ASSERT_TRUE(findLastingLoad(dynamics, expected.x, d, load));
  EXPECT_LT((load.x - expected.x).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((load.torque - expected.tau).cwiseAbs().maxCoeff(), 1e-9);
}

// On a slope of 2 degrees all weight is carried by the point of contact: about it gravity has no
// moment, and the wheels hold the ball against what pulls it down.
TEST(LastingLoad, OnASlopeTheCentreOfMassIsAboveTheContact) {
  const ReducedDynamics dynamics(exampleRobot());
  const RobotParameters& robot = dynamics.robot();
  const double slope = 2 * M_PI / 180, pull = robot.totalMass() * robot.gravity * std::sin(slope);
  VelocityVector d = VelocityVector::Zero();
  d[kBallVx] = pull;  // gravity's part along the floor; what it does to the lean is left out
  LastingLoad load;
  ASSERT_TRUE(findLastingLoad(dynamics, posed(0, robot.nominal_arm), d, load));
  StateVector moved = load.x;
  moved[kBallX] = 0;
  // Lever of the weight about the ball's centre, from the potential energy by pitch and roll.
  const auto energy = [&](double dpitch) {
    PositionVector q = load.x.head<kPositionDim>();
    q[kPitch] += dpitch;
    return dynamics.potentialEnergy(q);
  };
  const double moment = -(energy(1e-5) - energy(-1e-5)) / 2e-5;
  EXPECT_NEAR(moment, -pull * robot.ball.radius, 1e-6);
  // And the wheels' torque on the ball is that of the pull at the ball's radius.
  const Vector3 on_ball_B = OmniwheelKinematics(robot).ballTorque(load.torque.head<kWheelCount>());
  const Vector3 on_ball_W =
      rotationFromYawPitchRoll(load.x[kYaw], load.x[kPitch], load.x[kRoll]) * on_ball_B;
  EXPECT_NEAR(on_ball_W.y(), -pull * robot.ball.radius, 1e-9);
  EXPECT_NEAR(on_ball_W.x(), 0, 1e-9);
}

TEST(LastingLoad, WithoutAForceNothingShifts) {
  const ReducedDynamics dynamics(exampleRobot());
  const Vector3 arm = dynamics.robot().nominal_arm;
  LastingLoad load;
  ASSERT_TRUE(findLastingLoad(dynamics, posed(0, arm), VelocityVector::Zero(), load));
  EXPECT_LT(load.shift.norm(), 1e-9);
  EXPECT_LT(load.acceleration.norm(), 1e-9);
  const StateVector rest = findEquilibrium(dynamics, arm).x;
  EXPECT_LT((load.x - rest).segment<2>(kPitch).norm(), 1e-9);
}

TEST(LastingLoad, WhatTheRobotCannotLeanAgainstIsRefused) {
  const ReducedDynamics dynamics(exampleRobot());
  VelocityVector d = VelocityVector::Zero();
  d[kOmegaY] = 1000;
  LastingLoad load;
  EXPECT_FALSE(findLastingLoad(dynamics, posed(0, dynamics.robot().nominal_arm), d, load));
  EXPECT_FALSE(load.acts);
  d[kOmegaY] = std::nan("");
  EXPECT_FALSE(findLastingLoad(dynamics, posed(0, dynamics.robot().nominal_arm), d, load));
}

}  // namespace
}  // namespace ballbot
