// What friction between wheels and ball allows: the margin that plans keep.
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "controller/traction_margin.hpp"
#include "model/wheel_loads.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

VelocityVector accelerationOf(const ReducedDynamics& dynamics, const StateVector& x,
                              const JointVector& tau) {
  return dynamics.acceleration(x.head<kPositionDim>(), x.tail<kVelocityDim>(), tau,
                               Vector3::Zero());
}

/// Rows of TractionMargin, exactly.
TractionMargin::Rows exactMargin(const RobotParameters& robot, double share, const WheelLoads& at) {
  const double lever = share * robot.wheels.friction * robot.wheels.radius;
  TractionMargin::Rows rows;
  rows << lever * at.normal - robot.wheels.radius * at.traction,
      lever * at.normal + robot.wheels.radius * at.traction;
  return rows;
}

struct Standing {
  RobotParameters robot = exampleRobot();
  ReducedDynamics dynamics{robot};
  Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
};

TEST(TractionMargin, IsExactAtRestAndToFirstOrderAboutIt) {
  const Standing at;
  const Constraints constraints(at.robot);
  const TractionMargin margin(at.robot, constraints);
  const WheelLoadModel loads(at.robot);
  ASSERT_TRUE(margin.isLimited());
  double before = 0;
  for (const double size : {0.0, 0.01, 0.1}) {
    StateVector x = at.rest.x;
    JointVector tau = at.rest.tau;
    x.segment<5>(kPitch) += size * (Eigen::Matrix<double, 5, 1>() << 1, -2, 1, 0.5, -1).finished();
    x[kYaw] = 100 * size;  // changes nothing
    tau += 10 * size * (JointVector() << 1, 0.5, -2, 3, 1, 1).finished();
    const auto exact = exactMargin(
        at.robot, constraints.traction_share,
        loads.at(x, accelerationOf(at.dynamics, x, tau), tau.head<3>(), Vector3::Zero()));
    const double error = (margin.at(x, tau) - exact).norm();
    EXPECT_LE(error, size == 0 ? 1e-9 : 60 * size * size) << size;
    EXPECT_GE(error, before);
    before = error;
  }
  EXPECT_GT(margin.at(at.rest.x, at.rest.tau).minCoeff(), 3);
}

TEST(TractionMargin, KnowsWhatAPushTakes) {
  const Standing at;
  const Constraints constraints(at.robot);
  const TractionMargin margin(at.robot, constraints);
  const WheelLoadModel loads(at.robot);
  VelocityVector force = VelocityVector::Zero();
  force.segment<2>(kBallVx) << 40, -20;
  force.segment<2>(kOmegaX) << 7, 14;
  const PositionVector q = at.rest.x.head<kPositionDim>();
  const Push push = Push::on(at.dynamics, q, force, 1);
  const VelocityVector dnu = push.acceleration;
  const auto exact =
      exactMargin(at.robot, constraints.traction_share,
                  loads.at(at.rest.x, dnu, at.rest.tau.head<3>(), Vector3(40, -20, 0)));
  const TractionMargin::Rows rest = margin.at(at.rest.x, at.rest.tau);
  EXPECT_LT((rest + margin.ofPush(push) - exact).norm(), 1e-6);
  EXPECT_LT(margin.ofPush(push).minCoeff(), -0.1) << "a wheel is unloaded";
  EXPECT_EQ(margin.ofPush(Push{}), TractionMargin::Rows::Zero());
}

/// Value, slopes and positive semidefinite Hessian; nothing where nothing is lacking.
TEST(TractionMargin, TheExpansionIsThatOfTheCost) {
  const Standing at;
  const TractionMargin margin(at.robot, Constraints(at.robot));
  for (const double size : {0.3, 3.0, 6.0}) {
    const StateVector x = at.rest.x;
    const JointVector tau =
        at.rest.tau + size * (JointVector() << 1, -0.8, 0.3, 1, 2, 1).finished();
    const auto cost = [&](const StateVector& state, const JointVector& torque) {
      double violation = 0;
      return tractionCost(margin.at(state, torque), 20, violation);
    };
    LqStage<kMpcStateDim, 6> lq, plain;
    lq.Pt().block<3, 3>(kArm1, 1).setConstant(7);  // of an earlier plan
    expandTractionCost<6>(margin, margin.at(x, tau), 20, false, lq);
    constexpr double h = 1e-6;
    for (int i = 0; i < kJointCount; ++i) {
      const JointVector step = h * JointVector::Unit(i);
      const double slope = (cost(x, tau + step) - cost(x, tau - step)) / (2 * h);
      EXPECT_NEAR(lq.r()[i], slope, 1e-5 * (1 + std::abs(slope))) << size;
    }
    for (int i = kPitch; i <= kArm1 + 2; ++i) {
      const StateVector step = h * StateVector::Unit(i);
      const double slope = (cost(x + step, tau) - cost(x - step, tau)) / (2 * h);
      EXPECT_NEAR(lq.q()[i], slope, 1e-5 * (1 + std::abs(slope))) << size;
    }
    Eigen::Matrix<double, 11, 11> H;
    H.topLeftCorner<5, 5>() = lq.Q().block<5, 5>(kPitch, kPitch);
    H.topRightCorner<5, 6>() = lq.Pt().block<5, 6>(kPitch, 0);
    H.bottomLeftCorner<6, 5>() = H.topRightCorner<5, 6>().transpose();
    H.bottomRightCorner<6, 6>() = lq.R() - plain.R();
    EXPECT_GE(H.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-9 * H.norm());
    EXPECT_EQ(H.norm() > 0, size > 1) << size;
  }
}

TEST(TractionMargin, IsNoneWhereNobodySaysWhatFrictionThereIs) {
  RobotParameters robot = exampleRobot();
  Constraints constraints(robot);
  constraints.traction_weight = 0;
  EXPECT_FALSE(TractionMargin(robot, constraints).isLimited());
  robot.wheels.friction = kUnlimited;
  EXPECT_FALSE(TractionMargin(robot, Constraints(robot)).isLimited());
}

}  // namespace
}  // namespace ballbot
