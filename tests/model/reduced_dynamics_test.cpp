#include "model/reduced_dynamics.hpp"

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr int kCases = 100;

class ReducedDynamicsTest : public ::testing::Test {
 protected:
  ReducedDynamics dynamics{exampleRobot()};
};

TEST_F(ReducedDynamicsTest, MassMatrixIsSymmetricAndPositiveDefinite) {
  for (int i = 0; i < kCases; ++i) {
    const MassMatrix M = dynamics.massMatrix(randomCase(i).x.head<8>());
    EXPECT_EQ(M, M.transpose());
    EXPECT_EQ(M.llt().info(), Eigen::Success) << "case " << i;
  }
}

TEST_F(ReducedDynamicsTest, AccelerationSolvesTheEquationsOfMotion) {
  for (int i = 0; i < kCases; ++i) {
    const RandomCase c = randomCase(i);
    const PositionVector q = c.x.head<8>();
    const VelocityVector nu = c.x.tail<8>();
    const VelocityVector residual =
        dynamics.massMatrix(q) * dynamics.acceleration(q, nu, c.tau, c.lambda) +
        dynamics.nonlinearEffects(q, nu) - dynamics.selectionMatrix(q).transpose() * c.tau -
        dynamics.endEffectorJacobian(q).topRows<3>().transpose() * c.lambda;
    EXPECT_LT(residual.norm(), 1e-11) << "case " << i;
  }
}

// The same nu' that the equations give must change the energy by just the power that comes in:
// this ties M, h, S and J_E to one another.
TEST_F(ReducedDynamicsTest, EnergyChangesByThePowerThatComesIn) {
  for (int i = 0; i < kCases; ++i) {
    const RandomCase c = randomCase(i);
    const StateVector dx = dynamics.derivative(c.x, c.tau, c.lambda);
    const double step = 1e-4;  // Richardson's h^4 error and rounding meet near 1e-9 of the energy
    const auto slope = [&](double h) {
      return (dynamics.energy(c.x + h * dx) - dynamics.energy(c.x - h * dx)) / (2 * h);
    };
    const double energy_rate = (4 * slope(step / 2) - slope(step)) / 3;
    const JointVector joint_rates = dynamics.selectionMatrix(c.x.head<8>()) * c.x.tail<8>();
    const double power = c.tau.dot(joint_rates) + c.lambda.dot(dynamics.endEffector(c.x).v_WE_W);
    EXPECT_NEAR(energy_rate, power, 1e-7 * (1 + std::abs(power))) << "case " << i;
  }
}

TEST_F(ReducedDynamicsTest, EulerRatesAreThoseOfTheRotation) {
  for (int i = 0; i < kCases; ++i) {
    const RandomCase c = randomCase(i);
    const PositionVector q = c.x.head<8>(), dq = positionRate(q, c.x.tail<8>());
    const double h = 1e-6;
    const auto rotation = [&](double t) {
      return rotationFromYawPitchRoll(q[kYaw] + t * dq[kYaw], q[kPitch] + t * dq[kPitch],
                                      q[kRoll] + t * dq[kRoll]);
    };
    const Vector3 w = logSO3(rotation(-h).transpose() * rotation(h)) / (2 * h);
    EXPECT_LT((w - c.x.segment<3>(8 + kOmegaX)).norm(), 1e-8) << "case " << i;
  }
}

TEST_F(ReducedDynamicsTest, TurningTheWorldAboutTheVerticalChangesNothing) {
  const double angle = 0.7;
  const Matrix3 Rz = rotationFromYawPitchRoll(angle, 0, 0);
  for (int i = 0; i < kCases; ++i) {
    const RandomCase c = randomCase(i);
    StateVector turned = c.x;
    turned[kYaw] += angle;
    turned.head<2>() = Rz.topLeftCorner<2, 2>() * c.x.head<2>();
    turned.segment<2>(8) = Rz.topLeftCorner<2, 2>() * c.x.segment<2>(8);
    VelocityVector expected = dynamics.acceleration(c.x.head<8>(), c.x.tail<8>(), c.tau, c.lambda);
    expected.head<2>() = (Rz.topLeftCorner<2, 2>() * expected.head<2>()).eval();
    const VelocityVector got =
        dynamics.acceleration(turned.head<8>(), turned.tail<8>(), c.tau, Rz * c.lambda);
    EXPECT_LT((got - expected).norm(), 1e-11 * (1 + expected.norm())) << "case " << i;
  }
}

TEST_F(ReducedDynamicsTest, PayloadActsAsItsWeightAtTheEndEffector) {
  RobotParameters loaded = exampleRobot();
  loaded.payload_mass = 1.5;
  const ReducedDynamics with_payload(loaded);
  const RandomCase c = randomCase(0);
  const PositionVector q = c.x.head<8>();
  const VelocityVector rest = VelocityVector::Zero();
  const VelocityVector difference =
      with_payload.nonlinearEffects(q, rest) - dynamics.nonlinearEffects(q, rest);
  const Vector3 weight(0, 0, 1.5 * loaded.gravity);
  EXPECT_LT((difference - dynamics.endEffectorJacobian(q).topRows<3>().transpose() * weight).norm(),
            1e-12);
}

TEST_F(ReducedDynamicsTest, StandsStillAtTheEquilibrium) {
  const Vector3 nominal = dynamics.robot().nominal_arm;
  for (const Vector3& arm : {nominal, Vector3(0.8, 0.4, 1.2), Vector3(-2, -1.5, 0.3)}) {
    const Equilibrium at = findEquilibrium(dynamics, arm);
    EXPECT_LT(dynamics.derivative(at.x, at.tau, Vector3::Zero()).norm(), 1e-12);
    EXPECT_EQ((at.x.segment<3>(kArm1)), arm);
  }
}

TEST_F(ReducedDynamicsTest, LeansForwardAtTheNominalArmPose) {
  const Equilibrium at = findEquilibrium(dynamics, dynamics.robot().nominal_arm);
  const double degree = kRadPerDeg;
  EXPECT_NEAR(at.x[kPitch] / degree, 1.18, 0.005);
  EXPECT_NEAR(at.x[kRoll], 0, 1e-15);
  EXPECT_LT((dynamics.endEffector(at.x).p_WE - Vector3(0.198, 0, 0.949)).cwiseAbs().maxCoeff(),
            0.5e-3);
}

TEST_F(ReducedDynamicsTest, SaysWhenThereIsNoEquilibrium) {
  RobotParameters heavy = exampleRobot();
  heavy.payload_mass = 30;
  try {
    findEquilibrium(ReducedDynamics(heavy), Vector3(0, 1.5, 0));
    FAIL() << "expected an error";
  } catch (const NumericalError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("no equilibrium within 30 degrees for the arm at "
                                               "(0.000, 1.500, 0.000) rad"));
  }
}

}  // namespace
}  // namespace ballbot
