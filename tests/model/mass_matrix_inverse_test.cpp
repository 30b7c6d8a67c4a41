#include "model/mass_matrix_inverse.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

TEST(MassMatrixInverse, TimesTheMatrixIsTheIdentity) {
  const ReducedDynamics dynamics(exampleRobot());
  for (int i = 0; i < 100; ++i) {
    const MassMatrix M = dynamics.massMatrix(randomCase(i).x.head<8>());
    const MassMatrix error = inverseOfPositiveDefinite(M) * M - MassMatrix::Identity();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-12) << "case " << i;
  }
}

TEST(MassMatrixInverse, PropagatesNaN) {
  MassMatrix M = MassMatrix::Identity();
  M(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(inverseOfPositiveDefinite(M).sum()));
}

}  // namespace
}  // namespace ballbot
