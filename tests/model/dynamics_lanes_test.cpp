#include <vector>

#include <gtest/gtest.h>

#include "model/ldlt.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

/// Arrays of `count` random cases.
struct Cases {
  explicit Cases(int count) {
    for (int i = 0; i < count; ++i) {
      const RandomCase c = randomCase(i);
      x.push_back(c.x);
      tau.push_back(c.tau);
      lambda.push_back(c.lambda);
    }
  }
  std::vector<StateVector> x;
  std::vector<JointVector> tau;
  std::vector<Vector3> lambda;
};

class DynamicsLanesTest : public ::testing::TestWithParam<int> {
 protected:
  ReducedDynamics dynamics{exampleRobot()};
};

TEST_P(DynamicsLanesTest, GiveEachStateTheBitsItGetsAlone) {
  const int count = GetParam();
  const Cases c(count);
  std::vector<StateVector> dx(count);
  std::vector<ReducedDynamics::Linearization> lin(count);
  std::vector<ReducedDynamics::EndEffectorLinearization> E(count);
  dynamics.derivatives(count, c.x.data(), c.tau.data(), c.lambda.data(), dx.data());
  dynamics.linearize(count, c.x.data(), c.tau.data(), c.lambda.data(), lin.data(), E.data());
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(dx[i], dynamics.derivative(c.x[i], c.tau[i], c.lambda[i])) << i;
    ReducedDynamics::Linearization alone;
    dynamics.linearize(c.x[i], c.tau[i], c.lambda[i], alone);
    EXPECT_EQ(lin[i].f, alone.f) << i;
    EXPECT_EQ(lin[i].df_dx, alone.df_dx) << i;
    EXPECT_EQ(lin[i].df_dtau, alone.df_dtau) << i;
    EXPECT_EQ(lin[i].df_dlambda, alone.df_dlambda) << i;
    ReducedDynamics::EndEffectorLinearization E_alone;
    dynamics.linearizeEndEffector(c.x[i], E_alone);
    EXPECT_EQ(E[i].value.R_WE, E_alone.value.R_WE) << i;
    EXPECT_EQ(E[i].jacobian, E_alone.jacobian) << i;
    EXPECT_EQ(E[i].dpose_dq, E_alone.dpose_dq) << i;
    EXPECT_EQ(E[i].dtwist_dq, E_alone.dtwist_dq) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, DynamicsLanesTest, ::testing::Values(0, 1, 2, 3, 4, 5, 9));

TEST_F(DynamicsLanesTest, NaNStaysInItsLane) {
  Cases c(4);
  c.x[2][kPitch] = std::numeric_limits<double>::quiet_NaN();
  StateVector dx[4];
  dynamics.derivatives(4, c.x.data(), c.tau.data(), c.lambda.data(), dx);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(dx[i].allFinite(), i != 2) << i;
}

TEST(Ldlt, SolvesWithTheMassMatrix) {
  const ReducedDynamics dynamics(exampleRobot());
  for (int i = 0; i < 100; ++i) {
    const RandomCase c = randomCase(i);
    const MassMatrix M = dynamics.massMatrix(c.x.head<8>());
    VelocityVector solution = c.x.tail<8>();
    Ldlt<double, 8>(M).solveInPlace(solution);
    EXPECT_LT((M * solution - c.x.tail<8>()).norm(), 1e-13) << "case " << i;
  }
}

}  // namespace
}  // namespace ballbot
