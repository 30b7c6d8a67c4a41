#include "controller/held_lqr.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

/// x_{k+1} = (A + B K) x_k of the linear model with torques held for h, by many small steps.
StateJacobian heldClosedLoop(const ReducedDynamics& dynamics, const LqrSolution& lqr,
                             const FeedbackGain& K, double h) {
  ReducedDynamics::Linearization model;
  dynamics.linearize(lqr.equilibrium.x, lqr.equilibrium.tau, Vector3::Zero(), model);
  constexpr int kSteps = 20000;
  StateJacobian x = StateJacobian::Identity();
  const TorqueJacobian& B = model.df_dtau;
  for (int i = 0; i < kSteps; ++i) {
    const StateJacobian slope = model.df_dx * x + B * K;
    const StateJacobian half = x + 0.5 * h / kSteps * slope;
    x += h / kSteps * (model.df_dx * half + B * K);
  }
  return x;
}

double spectralRadius(const StateJacobian& A) {
  return eigenvaluesOf(A).cwiseAbs().maxCoeff();
}

/// The example robot with arm links ten times lighter.
RobotParameters lightArm() {
  RobotParameters robot = exampleRobot();
  for (ArmLink& link : robot.arm) {
    link.inertia.mass /= 10;
    link.inertia.I_LLcm_L /= 10;
  }
  return robot;
}

TEST(HeldLqr, HoldsALightArmForWhichTheContinuousGainIsTooQuick) {
  const ReducedDynamics dynamics(lightArm());
  const LqrWeights weights;
  const LqrSolution lqr = designLqr(dynamics, dynamics.robot().nominal_arm, weights);
  for (const double h : {0.02, 0.05}) {
    std::vector<double> knots;
    for (int k = 0; k <= std::lround(1 / h); ++k) knots.push_back(k * h);
    const auto gains = designHeldLqr(dynamics, lqr, weights, knots);
    ASSERT_EQ(gains.size() + 1, knots.size());
    EXPECT_GT(spectralRadius(heldClosedLoop(dynamics, lqr, lqr.K, h)), 1.5) << h;
    EXPECT_LT(spectralRadius(heldClosedLoop(dynamics, lqr, gains.front(), h)), 1) << h;
    EXPECT_LT(spectralRadius(heldClosedLoop(dynamics, lqr, gains.back(), h)), 1) << h;
  }
}

TEST(HeldLqr, OverShortStepsIsTheContinuousLqr) {
  const ReducedDynamics dynamics(exampleRobot());
  const LqrWeights weights;
  const LqrSolution lqr = designLqr(dynamics, dynamics.robot().nominal_arm, weights);
  for (const FeedbackGain& K : designHeldLqr(dynamics, lqr, weights, {0, 1e-5, 2e-5, 4e-5})) {
    EXPECT_LT((K - lqr.K).norm(), 5e-3 * lqr.K.norm());
  }
}

}  // namespace
}  // namespace ballbot
