#include "controller/spin_torque.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"
#include "model/spinning_dynamics.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

StateVector leaning(double pitch, double roll) {
  StateVector x = StateVector::Zero();
  x[kYaw] = 0.7;
  x[kPitch] = pitch;
  x[kRoll] = roll;
  return x;
}

// Upright, with the wheels at 45 degrees: r / r_w times the sine of it, for each wheel alike.
TEST(SpinTorque, UprightIsTheSumOfTheWheelsTimesOneNumber) {
  const RobotParameters robot = exampleRobot();
  const Vector3 c = SpinTorque(robot).at(leaning(0, 0)).c;
  const double expected = robot.ball.radius / robot.wheels.radius * std::sin(M_PI / 4);
  EXPECT_LT((c - Vector3::Constant(expected)).norm(), 1e-12);
}

TEST(SpinTorque, ItsDerivativesAreThoseOfItsValue) {
  const SpinTorque spin(exampleRobot());
  constexpr double h = 1e-6;
  const auto at = spin.at(leaning(0.2, -0.3));
  const Vector3 by_pitch =
      (spin.at(leaning(0.2 + h, -0.3)).c - spin.at(leaning(0.2 - h, -0.3)).c) / (2 * h);
  const Vector3 by_roll =
      (spin.at(leaning(0.2, -0.3 + h)).c - spin.at(leaning(0.2, -0.3 - h)).c) / (2 * h);
  EXPECT_LT((at.by_pitch - by_pitch).norm(), 1e-9);
  EXPECT_LT((at.by_roll - by_roll).norm(), 1e-9);
}

TEST(SpinTorque, WhatIsTooMuchIsCutAcrossBalance) {
  const RobotParameters robot = exampleRobot();
  const SpinTorque spin(robot);
  const StateVector x = leaning(0, 0);
  const Vector3 tau(2, -1, 0.5), cut = spin.within(0.4, x, tau);
  EXPECT_NEAR(spin.at(x).c.dot(cut), 0.4, 1e-12);
  Matrix3 axles;
  for (int i = 0; i < kWheelCount; ++i) axles.row(i) = robot.wheelAxle(i).transpose();
  const Vector3 change = axles.transpose() * (cut - tau);  // of the torque on the ball
  EXPECT_LT(change.head<2>().norm(), 1e-12) << "what balances stays";
  EXPECT_GT(std::abs(change.z()), 0.5);
  EXPECT_EQ(spin.within(4, x, tau), tau);
}

// The model's own account of it: the floor returns what of the wheels' torque does not speed up the
// wheels, which is little.
TEST(SpinTorque, IsWhatTheFloorReturnsButForTheWheelsInertia) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  const SpinningDynamics spinning(robot);
  const SpinTorque spin(robot);
  const OmniwheelKinematics wheels(robot);
  Matrix3 axles;
  for (int i = 0; i < kWheelCount; ++i) axles.row(i) = robot.wheelAxle(i).transpose();
  for (int k = 0; k < 50; ++k) {
    const RandomCase c = randomCase(k);
    const StateVector dx = dynamics.derivative(c.x, c.tau, c.lambda);
    const auto wheelSpins = [&](double t) -> Vector3 {
      const StateVector x = c.x + t * dx;
      const Matrix3 R_WB = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
      return axles * x.segment<3>(kPositionDim + kOmegaX) +
             wheels.wheelRows(R_WB) * x.tail<kVelocityDim>();
    };
    constexpr double h = 1e-5;
    const Vector3 inertial = robot.wheels.spin_inertia * (wheelSpins(h) - wheelSpins(-h)) / (2 * h);
    const Vector3 tau = c.tau.head<kWheelCount>(), n = spin.at(c.x).c;
    const double floor = spinning.floorSpinTorque(c.x, c.tau, c.lambda);
    EXPECT_NEAR(floor, -n.dot(tau - inertial), 1e-7 * (1 + std::abs(floor))) << "case " << k;
    EXPECT_NEAR(floor, spinning.floorSpinTorque(c.x, dx.tail<kVelocityDim>(), c.tau), 1e-12);
  }
}

/// Value, gradient and positive semidefinite Hessian of the barrier, within its limit and beyond.
TEST(SpinTorque, TheExpansionIsThatOfTheCost) {
  const RobotParameters robot = exampleRobot();
  const SpinTorque spin(robot);
  Constraints limits(robot);
  limits.takeFloor(0.8);
  for (const double size : {0.05, 0.3, 2.0}) {
    const StateVector x = leaning(0.1, -0.15);
    const Vector3 tau = size * Vector3(1, 0.4, 0.7);
    LqStage<kMpcStateDim, 6> lq;
    expandSpinTorqueCost<6>(spin, limits, x, tau, 0.02, lq);
    const auto cost = [&](const StateVector& at, const Vector3& torque) {
      double violation = 0;
      return spinTorqueCost(spin, limits, at, torque, 0.02, violation);
    };
    constexpr double h = 1e-6;
    for (int i = 0; i < kWheelCount; ++i) {
      const Vector3 step = h * Vector3::Unit(i);
      const double slope = (cost(x, tau + step) - cost(x, tau - step)) / (2 * h);
      EXPECT_NEAR(lq.r()[i], slope, 1e-6 * (1 + std::abs(slope))) << size;
    }
    for (const int i : {kPitch, kRoll}) {
      const StateVector step = h * StateVector::Unit(i);
      const double slope = (cost(x + step, tau) - cost(x - step, tau)) / (2 * h);
      EXPECT_NEAR(lq.q()[i], slope, 1e-6 * (1 + std::abs(slope))) << size;
    }
    Eigen::Matrix<double, 5, 5> H;  // pitch, roll, wheels: of rank one
    H.topLeftCorner<2, 2>() = lq.Q().block<2, 2>(kPitch, kPitch);
    H.topRightCorner<2, 3>() = lq.Pt().block<2, 3>(kPitch, 0);
    H.bottomLeftCorner<3, 2>() = H.topRightCorner<2, 3>().transpose();
    H.bottomRightCorner<3, 3>() =
        lq.R().topLeftCorner<3, 3>() - LqStage<kMpcStateDim, 6>().R().topLeftCorner<3, 3>();
    EXPECT_GT(H.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12 * H.norm());
    EXPECT_GT(H.norm(), 0);
  }
  double violation = 0;
  EXPECT_NEAR(spinTorqueCost(spin, limits, leaning(0, 0), Vector3::Zero(), 1, violation), 0, 1e-15);
}

}  // namespace
}  // namespace ballbot
