#include "capture/balance_model.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "controller/rigid_arm.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

const Vector3 kPoint(0, 0, 0.35);

BalanceModel exampleModel() {
  const RobotParameters robot = exampleRobot();
  return BalanceModel::of(robot, robot.nominal_arm, kPoint);
}

TEST(BalanceModel, FallsAtTheRatesOfTheArmLockedRobot) {
  const BalanceModel m = exampleModel();
  Eigen::VectorXd poles = m.A.eigenvalues().real();
  std::sort(poles.data(), poles.data() + poles.size());
  EXPECT_NEAR(poles[6], 5.21, 0.01);  // docs/theory/loop.md: the arm locked
  EXPECT_NEAR(poles[5], 5.15, 0.01);
  EXPECT_NEAR(m.pitch_at_rest, 1.18 / 57.2958, 1e-4);
  EXPECT_NEAR(m.roll_at_rest, 0, 1e-12);
  EXPECT_NEAR(m.weight, 25 * 9.81, 1e-9);
}

// The same force as a force and a moment on the end-effector, whose derivatives are another's work.
TEST(BalanceModel, AForceOnTheBaseIsAForceAndAMomentOnTheHand) {
  const RobotParameters robot = exampleRobot();
  const BalanceModel m = exampleModel();
  const ReducedDynamics dynamics(withRigidArm(robot, robot.nominal_arm));
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  const Vector3 none = Vector3::Zero();
  ReducedDynamics::Linearization at_rest;
  dynamics.linearize(rest.x, rest.tau, none, at_rest, &none);
  const Matrix3 R_WB = rotationFromYawPitchRoll(0, rest.x[kPitch], rest.x[kRoll]);
  const Vector3 p_KE_W = dynamics.endEffector(rest.x).p_WE - Vector3(0, 0, robot.ball.radius);
  const ForceJacobian by_force =
      at_rest.df_dlambda + at_rest.df_dmoment * skew(R_WB * kPoint - p_KE_W);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT((m.E.col(i).tail<5>() - by_force.col(i).segment<5>(kPositionDim)).norm(),
              1e-9 * m.E.col(i).norm());
  }
}

// Of what stands on the ball the momentum along the floor changes by what the wheels and the push
// bring, torques and pushes alike.
TEST(BalanceModel, WhatItsWheelsBearChangesTheMomentum) {
  const RobotParameters robot = exampleRobot();
  const BalanceModel m = exampleModel();
  const Matrix3 R_WB = rotationFromYawPitchRoll(0, m.pitch_at_rest, m.roll_at_rest);
  Eigen::Matrix<double, 2, kWheelCount> normals, tangents;
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 c = robot.contactDirection(i);
    normals.col(i) = (R_WB * c).head<2>();
    tangents.col(i) = (R_WB * c.cross(robot.wheelAxle(i))).head<2>();
  }
  Eigen::Matrix<double, 2, BalanceModel::kStates> of_carried = m.momentum_rate;
  of_carried.block<2, 2>(0, BalanceModel::kRates) -= robot.ball.mass * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 2, kWheelCount> by_torque =
      normals * m.normal_force.by_torque + tangents * m.traction.by_torque;
  EXPECT_LT((by_torque - of_carried * m.B).norm(), 1e-6 * by_torque.norm());
  const Eigen::Matrix2d by_force =
      normals * m.normal_force.by_force + tangents * m.traction.by_force;
  EXPECT_LT((by_force - (of_carried * m.E - Eigen::Matrix2d::Identity())).norm(), 1e-6);
  EXPECT_GT(m.normal_force.at_rest.minCoeff(), 95);
  EXPECT_LT(m.traction.at_rest.cwiseAbs().maxCoeff(), 1);
}

// What the ball's rolling and the wheels' turning add to the mass matrix is no momentum.
TEST(BalanceModel, ItsMomentumIsTheMassMatrixWithoutWhatTurns) {
  const RobotParameters robot = exampleRobot();
  const BalanceModel m = exampleModel();
  const ReducedDynamics dynamics(withRigidArm(robot, robot.nominal_arm));
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  const PositionVector q = rest.x.head<kPositionDim>();
  const Eigen::Matrix<double, 5, 5> M = dynamics.massMatrix(q).topLeftCorner<5, 5>();
  const Eigen::Matrix<double, 3, 5> S = dynamics.selectionMatrix(q).topLeftCorner<3, 5>();
  Eigen::Matrix<double, 2, 5> expected =
      M.topRows<2>() - robot.wheels.spin_inertia * S.leftCols<2>().transpose() * (S + [&] {
                         // a wheel turns in the world by its rate plus the base's about its axle
                         Eigen::Matrix<double, 3, 5> base;
                         base.setZero();
                         for (int w = 0; w < kWheelCount; ++w)
                           base.block<1, 3>(w, 2) = robot.wheelAxle(w).transpose();
                         return base;
                       }());
  expected.leftCols<2>() -=
      robot.ball.inertia / (robot.ball.radius * robot.ball.radius) * Eigen::Matrix2d::Identity();
  EXPECT_LT((m.momentum_rate.rightCols<5>() - expected).norm(), 1e-9 * expected.norm());
}

TEST(BalanceStep, TwoHalvesAreAWhole) {
  const BalanceModel m = exampleModel();
  const BalanceStep whole(m, 0.3), half(m, 0.15);
  EXPECT_LT((half.A * half.A - whole.A).norm(), 1e-11 * whole.A.norm());
  EXPECT_LT((half.A * half.B + half.B - whole.B).norm(), 1e-11 * whole.B.norm());
  EXPECT_LT((half.A * half.E + half.E - whole.E).norm(), 1e-11 * whole.E.norm());
}

TEST(BalanceStep, BeginsAsItsDerivative) {
  const BalanceModel m = exampleModel();
  const double h = 1e-5;
  const BalanceStep step(m, h);
  const auto one = BalanceModel::StateMatrix::Identity();
  EXPECT_LT(((step.A - one) / h - m.A).norm(), 1e-3 * m.A.norm());
  EXPECT_LT((step.B / h - m.B).norm(), 1e-3 * m.B.norm());
  EXPECT_LT((step.E / h - m.E).norm(), 1e-3 * m.E.norm());
}

}  // namespace
}  // namespace ballbot
