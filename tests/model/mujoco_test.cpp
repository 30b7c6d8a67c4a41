#include <gtest/gtest.h>

#include "model/spinning_dynamics.hpp"
#include "tests/model/mujoco_robot.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

void expectEqualAccelerations(const RobotParameters& robot) {
  const ReducedDynamics dynamics(robot);
  MujocoRobot mujoco(robot);
  for (int i = 0; i < 100; ++i) {
    const RandomCase c = randomCase(i);
    const PositionVector q = c.x.head<kPositionDim>();
    const VelocityVector nu = c.x.tail<kVelocityDim>();
    const VelocityVector expected = mujoco.acceleration(q, nu, c.tau, c.lambda);
    const VelocityVector got = dynamics.acceleration(q, nu, c.tau, c.lambda);
    EXPECT_LT((got - expected).norm(), 1e-9 * expected.norm()) << "case " << i;
    EXPECT_LT((dynamics.endEffector(c.x).p_WE - mujoco.endEffectorPosition()).norm(), 1e-12);
  }
}

void expectEqualAccelerationsOfASpinningBall(const RobotParameters& robot) {
  const SpinningDynamics dynamics(robot);
  MujocoRobot mujoco(robot);
  for (int i = 0; i < 100; ++i) {
    const RandomCase c = randomCase(i);
    const PositionVector q = c.x.head<kPositionDim>();
    SpinningVelocityVector nu;
    nu << c.x.tail<kVelocityDim>(), 0.3 * c.tau[5];
    const double floor_torque = 0.1 * c.tau[0];
    const auto expected = mujoco.acceleration(q, nu, c.tau, c.lambda, floor_torque);
    const auto got = dynamics.acceleration(q, nu, c.tau, c.lambda, floor_torque);
    EXPECT_LT((got - expected).norm(), 1e-9 * expected.norm()) << "case " << i;
  }
}

TEST(Mujoco, GivesTheSameAccelerations) { expectEqualAccelerations(exampleRobot()); }

TEST(Mujoco, GivesTheSameAccelerationsOfASpinningBall) {
  expectEqualAccelerationsOfASpinningBall(exampleRobot());
}

TEST(Mujoco, GivesTheSameAccelerationsWithPayload) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 1.5;
  expectEqualAccelerations(robot);
}

// Nothing of the example's symmetry may be built into the equations.
TEST(Mujoco, GivesTheSameAccelerationsForALopsidedRobot) {
  RobotParameters robot = exampleRobot();
  robot.base.p_LLcm_L += Vector3(0.02, -0.03, 0.01);
  robot.base.I_LLcm_L(0, 1) = robot.base.I_LLcm_L(1, 0) = 0.05;
  robot.wheels.azimuth = {0.1, 1.9, 4.5};
  robot.wheels.contact_zenith = 0.7;
  robot.arm[0].axis = Vector3(0.1, -0.2, 1).normalized();
  robot.arm[1].p_PJ_P = Vector3(0.02, 0.01, 0.08);
  robot.arm[1].axis = Vector3(0.3, 1, 0.1).normalized();
  robot.arm[2].inertia.p_LLcm_L = Vector3(0.01, -0.02, 0.2);
  robot.arm[2].inertia.I_LLcm_L(0, 2) = robot.arm[2].inertia.I_LLcm_L(2, 0) = 0.001;
  robot.p_A3E = Vector3(0.05, 0.02, 0.35);
  expectEqualAccelerations(robot);
  expectEqualAccelerationsOfASpinningBall(robot);
}

/// Of each joint in turn, and of all of them: a lift, a telescope, a gantry.
TEST(Mujoco, GivesTheSameAccelerationsOfArmsThatSlide) {
  for (int slides = 1; slides < 8; ++slides) {
    RobotParameters robot = exampleRobot();
    for (int i = 0; i < kArmJointCount; ++i) {
      if (slides >> i & 1) robot.arm[i].lead = 0.05 * (1 + i);
      robot.arm[i].axis = (robot.arm[i].axis + Vector3(0.2, -0.1, 0.3)).normalized();
    }
    expectEqualAccelerations(robot);
    expectEqualAccelerationsOfASpinningBall(robot);
  }
}

}  // namespace
}  // namespace ballbot
