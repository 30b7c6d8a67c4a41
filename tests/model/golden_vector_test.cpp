#include <gtest/gtest.h>

#include "model/omniwheel_kinematics.hpp"
#include "tests/model/robot_fixture.hpp"

// One state of the example robot for which three independent models agree to the last digit given:
// these equations, a Lagrangian derivation, and a Simbody model with a freely rolling ball.

namespace ballbot {
namespace {

constexpr double kDigits = 0.5e-6;

class GoldenVector : public ::testing::Test {
 protected:
  GoldenVector() {
    q << 0.1, -0.2, 0.3, 0.05, -0.08, 0.4, -0.5, 2;
    nu << 0.2, -0.1, 0.3, -0.4, 0.5, 0.6, -0.7, 0.8;
    tau << 1, -0.5, 0.3, 2, -1, 0.5;
    x << q, nu;
  }

  ReducedDynamics dynamics{exampleRobot()};
  PositionVector q;
  VelocityVector nu;
  StateVector x;
  JointVector tau;
  Vector3 lambda{-5, 1, 2};
};

TEST_F(GoldenVector, Acceleration) {
  VelocityVector expected;
  expected << 0.163762, 0.282253, -3.487222, 1.816035, -17.089265, 75.616355, -30.616427, 44.224531;
  const VelocityVector error = dynamics.acceleration(q, nu, tau, lambda) - expected;
  EXPECT_LE(error.cwiseAbs().maxCoeff(), kDigits) << error.transpose();
}

TEST_F(GoldenVector, WheelRates) {
  const Vector3 expected(-1.754874, -1.829769, 2.196218);
  const JointVector rates = dynamics.selectionMatrix(q) * nu;
  EXPECT_LE((rates.head<3>() - expected).cwiseAbs().maxCoeff(), kDigits);
  EXPECT_EQ(rates.tail<3>(), nu.tail<3>());
}

TEST_F(GoldenVector, EndEffector) {
  const auto E = dynamics.endEffector(x);
  EXPECT_LE((E.p_WE - Vector3(0.277377, 0.010897, 0.973344)).cwiseAbs().maxCoeff(), kDigits);
  EXPECT_LE((E.v_WE_W - Vector3(-0.339080, -0.398328, 0.004140)).cwiseAbs().maxCoeff(), kDigits);
  EXPECT_LE((E.w_WE_W - Vector3(0.367335, -0.115612, 1.106639)).cwiseAbs().maxCoeff(), kDigits);
}

TEST_F(GoldenVector, MassMatrixAndNonlinearEffects) {
  VelocityVector diagonal, h;
  diagonal << 26.741918, 26.740292, 4.073835, 4.109119, 0.231137, 0.049094, 0.214811, 0.075409;
  h << 2.248921, -1.540373, 6.208456, -1.333335, 0.082893, 0.076107, 0.369702, -2.466329;
  EXPECT_LE((dynamics.massMatrix(q).diagonal() - diagonal).cwiseAbs().maxCoeff(), kDigits);
  EXPECT_LE((dynamics.nonlinearEffects(q, nu) - h).cwiseAbs().maxCoeff(), kDigits);
}

}  // namespace
}  // namespace ballbot
