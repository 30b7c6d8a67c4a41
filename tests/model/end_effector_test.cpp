#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/model/sliding_robot.hpp"

namespace ballbot {
namespace {

constexpr int kCases = 100;
using PoseChange = Eigen::Matrix<double, 6, 1>;

/// The shipped robot, and one whose second arm joint slides.
class EndEffectorTest : public ::testing::TestWithParam<bool> {
 protected:
  /// Central differences of pose and twist along a change of the state, extrapolated once.
  void difference(const StateVector& x, const StateVector& along, PoseChange& pose,
                  PoseChange& twist) const {
    const auto slope = [&](double h, PoseChange& dpose, PoseChange& dtwist) {
      const auto a = dynamics.endEffector(x - h * along), b = dynamics.endEffector(x + h * along);
      const Matrix3 R = dynamics.endEffector(x).R_WE;
      // Rotation vectors from the middle, in axes of W.
      const Vector3 turn = R * (logSO3(R.transpose() * b.R_WE) - logSO3(R.transpose() * a.R_WE));
      dpose << b.p_WE - a.p_WE, turn;
      dtwist << b.v_WE_W - a.v_WE_W, b.w_WE_W - a.w_WE_W;
      dpose /= 2 * h;
      dtwist /= 2 * h;
    };
    PoseChange pose_half, twist_half;
    slope(1e-3, pose, twist);
    slope(0.5e-3, pose_half, twist_half);
    pose = (4 * pose_half - pose) / 3;
    twist = (4 * twist_half - twist) / 3;
  }

  ReducedDynamics dynamics{GetParam() ? withASlide(exampleRobot()) : exampleRobot()};
};

TEST_P(EndEffectorTest, VelocityIsTheDerivativeOfThePose) {
  for (int i = 0; i < kCases; ++i) {
    const RandomCase c = randomCase(i);
    StateVector along = StateVector::Zero();
    along.head<8>() = positionRate(c.x.head<8>(), c.x.tail<8>());
    PoseChange pose, twist;
    difference(c.x, along, pose, twist);
    const auto E = dynamics.endEffector(c.x);
    EXPECT_LT((pose.head<3>() - E.v_WE_W).norm(), 1e-9) << "case " << i;
    EXPECT_LT((pose.tail<3>() - E.w_WE_W).norm(), 1e-9) << "case " << i;
  }
}

TEST_P(EndEffectorTest, JacobiansAgreeWithDifferences) {
  for (int i = 0; i < kCases; ++i) {
    const RandomCase c = randomCase(i);
    ReducedDynamics::EndEffectorLinearization lin;
    dynamics.linearizeEndEffector(c.x, lin);
    for (int k = 0; k < kPositionDim; ++k) {
      PoseChange pose, twist;
      difference(c.x, StateVector::Unit(k), pose, twist);
      EXPECT_LT((lin.dpose_dq.col(k) - pose).norm(), 1e-9) << "case " << i << " column " << k;
      EXPECT_LT((lin.dtwist_dq.col(k) - twist).norm(), 1e-9) << "case " << i << " column " << k;
      difference(c.x, StateVector::Unit(kPositionDim + k), pose, twist);
      EXPECT_LT((lin.jacobian.col(k) - twist).norm(), 1e-9) << "case " << i << " column " << k;
    }
  }
}

TEST_P(EndEffectorTest, JacobianTakesVelocityToTwist) {
  const RandomCase c = randomCase(0);
  const auto E = dynamics.endEffector(c.x);
  const PoseChange twist = dynamics.endEffectorJacobian(c.x.head<8>()) * c.x.tail<8>();
  EXPECT_LT((twist.head<3>() - E.v_WE_W).norm(), 1e-14);
  EXPECT_LT((twist.tail<3>() - E.w_WE_W).norm(), 1e-14);
}

TEST_P(EndEffectorTest, ComesWithTheDynamicsBitForBit) {
  const RandomCase c = randomCase(0);
  ReducedDynamics::Linearization alone, together;
  ReducedDynamics::EndEffectorLinearization E_alone, E_together;
  dynamics.linearize(c.x, c.tau, c.lambda, alone);
  dynamics.linearizeEndEffector(c.x, E_alone);
  dynamics.linearize(1, &c.x, &c.tau, &c.lambda, &together, &E_together);
  EXPECT_EQ(alone.df_dx, together.df_dx);
  EXPECT_EQ(E_alone.dtwist_dq, E_together.dtwist_dq);
  EXPECT_EQ(E_alone.value.p_WE, E_together.value.p_WE);
}

INSTANTIATE_TEST_SUITE_P(Turning, EndEffectorTest, ::testing::Values(false));
INSTANTIATE_TEST_SUITE_P(Sliding, EndEffectorTest, ::testing::Values(true));

TEST(EndEffector, IsLevelAtTheNominalArmPose) {
  const ReducedDynamics dynamics(exampleRobot());
  StateVector x = StateVector::Zero();
  x.segment<3>(kArm1) = dynamics.robot().nominal_arm;
  const auto E = dynamics.endEffector(x);
  EXPECT_LT((E.R_WE - Matrix3::Identity()).norm(), 1e-15);
  EXPECT_LT((E.p_WE - Vector3(0.181, 0, 0.953)).cwiseAbs().maxCoeff(), 0.5e-3);
}

}  // namespace
}  // namespace ballbot
