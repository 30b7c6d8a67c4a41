#include "estimator/filter_state.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot::test {
namespace {

TangentVector randomTangent(std::uint64_t seed, double scale) {
  const RandomStream random(seed, "tangent");
  TangentVector d;
  for (int i = 0; i < kTangentDim; ++i)
    d[i] = scale * random.normals(static_cast<std::uint64_t>(i))[0];
  return d;
}

TEST(FilterState, PlusAndMinusUndoEachOther) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const FilterState x = FilterState{}.plus(randomTangent(seed, 0.7));
    const TangentVector d = randomTangent(seed + 100, 0.3);
    EXPECT_LT((x.plus(d).minus(x) - d).norm(), 1e-12);
  }
}

TEST(FilterState, PlusAndMinusKnowTheSpinWhereItIsEstimated) {
  using SpinTangent = BasicTangentVector<kSpinTangentDim>;
  FilterState x;
  x.spin = 0.4;
  const SpinTangent d = 0.1 * SpinTangent::Ones();
  EXPECT_NEAR(x.plus(d).spin, 0.5, 1e-15);
  EXPECT_LT((x.plus(d).minus<kSpinTangentDim>(x) - d).norm(), 1e-12);
  const TangentVector without = d.head<kTangentDim>();
  EXPECT_EQ(x.plus(without).spin, 0.4);
}

TEST(FilterState, StaysOnTheManifoldThroughAMillionUpdates) {
  FilterState x;
  const TangentVector d = randomTangent(1, 1e-2), e = randomTangent(2, 1e-2);
  for (int i = 0; i < 500000; ++i) x = x.plus(d).plus(e);
  EXPECT_LT((x.R_WB.transpose() * x.R_WB - Matrix3::Identity()).norm(), 1e-14);
  EXPECT_NEAR(x.R_WB.determinant(), 1.0, 1e-14);
}

TEST(InverseRightJacobian, AgreesWithDifferences) {
  const double d = 1e-6;
  for (const double angle : {1e-9, 1e-3, 0.019, 0.021, 0.5, 2.0, 3.0}) {
    const Vector3 phi = angle * Vector3(0.6, -0.48, 0.64);
    Matrix3 numeric;
    for (int i = 0; i < 3; ++i) {
      numeric.col(i) = (logSO3(expSO3(phi) * expSO3(d * Vector3::Unit(i))) -
                        logSO3(expSO3(phi) * expSO3(-d * Vector3::Unit(i)))) /
                       (2 * d);
    }
    EXPECT_LT((numeric - inverseRightJacobian(phi)).norm(), 2e-9) << angle;
  }
}

TEST(Orthonormalized, RemovesASmallErrorToSecondOrder) {
  const Matrix3 R = rotationFromYawPitchRoll(1, 0.3, -0.2);
  const Matrix3 S = R * (Matrix3::Identity() + 1e-6 * Matrix3::Ones());
  EXPECT_LT((orthonormalized(S).transpose() * orthonormalized(S) - Matrix3::Identity()).norm(),
            1e-10);
}

TEST(Unwrapped, FollowsManyTurns) {
  double yaw = 0;
  for (int i = 0; i < 1000; ++i) {
    const double truth = 0.05 * i;
    yaw = unwrapped(std::remainder(truth, 2 * std::acos(-1.0)), yaw);
    EXPECT_NEAR(yaw, truth, 1e-12);
  }
}

}  // namespace
}  // namespace ballbot::test
