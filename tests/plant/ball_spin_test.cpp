#include <cmath>

#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "model/spinning_dynamics.hpp"
#include "plant/multibody.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

/// dnu/dt of the plant's bodies. The ball's spin is one of the numbers in y, and so its rate one of
/// those in dy/dt.
SpinningVelocityVector accelerationOf(Multibody& plant, const RandomMotion& motion) {
  std::vector<double> y = stateOf(plant, motion), ydot(y.size());
  plant.realize(y.data());
  const Matrix3 R_WB = plant.base().R_WB;
  const double spin = plant.base().ball_spin;
  plant.derivative(motion.loads, ydot.data());
  const BaseAcceleration base = plant.baseAcceleration(ydot.data());
  const JointAcceleration joints = plant.jointAcceleration(ydot.data());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += ydot[i];
  plant.realize(y.data());
  SpinningVelocityVector out;
  out << base.a_WK_W.head<2>(), R_WB.transpose() * base.alpha_WB_W, joints.joint.tail<3>(),
      plant.base().ball_spin - spin;
  return out;
}

void expectAgreement(const RobotParameters& robot, double friction, double smoothing) {
  const SpinningDynamics model(robot);
  for (const auto structure : {MultibodyStructure::kFull, MultibodyStructure::kReducedWheels}) {
    const auto plant = makeMultibody(robot, multibodyOptions(structure, false, true));
    for (int i = 0; i < 100; ++i) {
      RandomMotion motion = randomMotion(i);
      const Vector3 force = motion.loads.forces.back().force_W;
      motion.loads.forces = {{kHandBody, robot.p_A3E, force}};
      const double floor = -friction * std::tanh(motion.ball_spin / smoothing);
      motion.loads.ball_spin_torque = floor;
      PositionVector q;
      q << motion.pose.px, motion.pose.py, motion.pose.yaw, motion.pose.pitch, motion.pose.roll,
          motion.pose.arm;
      SpinningVelocityVector nu;
      nu << motion.nu, motion.ball_spin;
      const auto expected = model.acceleration(q, nu, motion.loads.joint_torque, force, floor);
      const SpinningVelocityVector got = accelerationOf(*plant, motion);
      EXPECT_LT((got - expected).norm(), 1e-9 * expected.norm()) << "state " << i;
    }
  }
}

TEST(BallSpin, OfThePlantIsThatOfTheSpinningDynamics) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 0.7;
  expectAgreement(robot, 0, 1);
}

TEST(BallSpin, UnderFrictionIsThatOfTheSpinningDynamics) {
  expectAgreement(exampleRobot(), 0.4, 0.02);
}

}  // namespace
}  // namespace ballbot
