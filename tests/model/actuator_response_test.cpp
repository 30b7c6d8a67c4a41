#include "model/actuator_response.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

/// A drive whose current loop is too fast to matter and whose spring has no damping: second order.
ActuatorParameters textbookDrive(double bandwidth_Hz) {
  ActuatorParameters p;
  p.current_loop_bandwidth = 1e7;
  p.spring_damping = 0;
  p.torque_bandwidth = bandwidth_Hz;
  return p;
}

TEST(ActuatorResponse, IsTheWantedSecondOrderSystemWithTheOutputBlocked) {
  for (const double f : {15.0, 40.0, 80.0}) {
    const ActuatorParameters p = textbookDrive(f);
    const ActuatorResponse response(p, 0);
    const double w0 = 2 * M_PI * f;
    for (const double ratio : {0.01, 0.3, 1.0, 2.0}) {
      const std::complex<double> s(0, ratio * w0);
      const std::complex<double> expected =
          w0 * w0 / (s * s + 2 * p.damping_ratio * w0 * s + w0 * w0);
      EXPECT_LT(std::abs(response.blocked(ratio * w0) - expected), 1e-4) << f << " at " << ratio;
    }
    EXPECT_NEAR(response.bandwidth(), w0, 1e-3 * w0);
  }
}

// What encoders measure is k times the deflection: blocked torque without the damping's share.
TEST(ActuatorResponse, TheWantedBandwidthIsFoundFromTheMeasuredOne) {
  ActuatorParameters p;
  const double k = p.spring_stiffness, d = p.spring_damping;
  for (const double measured_Hz : {20.0, 40.0, 60.0}) {
    const double omega = 2 * M_PI * measured_Hz;
    p.torque_bandwidth = torqueBandwidthFor(p, 4e-4, measured_Hz);
    const std::complex<double> torque = ActuatorResponse(p, 4e-4).blocked(omega);
    EXPECT_NEAR(std::abs(torque * k / std::complex<double>(k, d * omega)), std::sqrt(0.5), 1e-6);
  }
  EXPECT_THROW(torqueBandwidthFor(p, 4e-4, 3), NumericalError);
  EXPECT_THROW(torqueBandwidthFor(p, 4e-4, 1e4), NumericalError);
}

TEST(ActuatorResponse, AFreeLoadFeelsTheRotorsInertiaThatTheLoopLeavesOver) {
  ActuatorParameters p = textbookDrive(40);
  p.viscous_friction = 1e-9;
  const double inertia = 0.044, leak = p.reflectedInertia() / (1 + p.torqueGainP());
  EXPECT_NEAR(std::abs(ActuatorResponse(p, 0).loaded(0.1, inertia)), 1 / (1 + leak / inertia),
              1e-4);
}

TEST(ActuatorResponse, AnImmovableLoadIsABlockedOutput) {
  const ActuatorResponse response(ActuatorParameters{}, 4e-4);
  for (const double omega : {1.0, 30.0, 400.0}) {
    EXPECT_LT(std::abs(response.loaded(omega, 1e12) - response.blocked(omega)), 1e-9);
  }
}

TEST(FreeInertia, IsTorqueOverTheJointsOwnAcceleration) {
  const ReducedDynamics dynamics(exampleRobot());
  const PositionVector q =
      findEquilibrium(dynamics, dynamics.robot().nominal_arm).x.head<kPositionDim>();
  const JointVector inertia = freeInertia(dynamics, q);
  const VelocityVector rest = VelocityVector::Zero();
  const VelocityVector drift = dynamics.acceleration(q, rest, JointVector::Zero(), Vector3::Zero());
  for (int j = 0; j < kJointCount; ++j) {
    const VelocityVector pushed =
        dynamics.acceleration(q, rest, JointVector::Unit(j), Vector3::Zero());
    const double joint_acceleration = dynamics.selectionMatrix(q).row(j).dot(pushed - drift);
    EXPECT_NEAR(inertia[j] * joint_acceleration, 1, 1e-9) << j;
  }
  EXPECT_NEAR(inertia[0], 0.045, 0.002);  // the example robot's wheels: 0.043 to 0.046 kg m^2
}

}  // namespace
}  // namespace ballbot
