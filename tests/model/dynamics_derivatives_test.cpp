#include <gtest/gtest.h>

#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

// Central differences, extrapolated twice (Richardson): error of order h^6.
TEST(DynamicsDerivatives, AgreeWithExtrapolatedDifferences) {
  const ReducedDynamics dynamics(exampleRobot());
  for (int k = 0; k < 100; ++k) {
    const RandomCase c = randomCase(k);
    ReducedDynamics::Linearization lin;
    dynamics.linearize(c.x, c.tau, c.lambda, lin);
    const double scale = 1 + lin.df_dx.cwiseAbs().maxCoeff();

    const StateVector f = dynamics.derivative(c.x, c.tau, c.lambda);
    EXPECT_LT((lin.f - f).norm(), 1e-12 * (1 + f.norm()));
    for (int i = 0; i < kStateDim; ++i) {
      const auto slope = [&](double h) -> StateVector {
        StateVector plus = c.x, minus = c.x;
        plus[i] += h;
        minus[i] -= h;
        return (dynamics.derivative(plus, c.tau, c.lambda) -
                dynamics.derivative(minus, c.tau, c.lambda)) /
               (2 * h);
      };
      const double h = 8e-3;
      const StateVector d1 = slope(h), d2 = slope(h / 2), d4 = slope(h / 4);
      const StateVector once = (4 * d2 - d1) / 3, twice = (4 * d4 - d2) / 3;
      const StateVector expected = (16 * twice - once) / 15;
      EXPECT_LT((lin.df_dx.col(i) - expected).norm(), 1e-9 * scale)
          << "case " << k << " column " << i;
    }
    // The acceleration is affine in torque and force: a unit step is exact.
    for (int i = 0; i < kJointCount; ++i) {
      const StateVector expected =
          dynamics.derivative(c.x, c.tau + JointVector::Unit(i), c.lambda) - f;
      EXPECT_LT((lin.df_dtau.col(i) - expected).norm(), 1e-11 * scale);
    }
    for (int i = 0; i < 3; ++i) {
      const StateVector expected = dynamics.derivative(c.x, c.tau, c.lambda + Vector3::Unit(i)) - f;
      EXPECT_LT((lin.df_dlambda.col(i) - expected).norm(), 1e-11 * scale);
    }
  }
}

}  // namespace
}  // namespace ballbot
