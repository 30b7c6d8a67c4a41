#include "metrics/home_frame.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

/// What the plant records of a robot in a state; pushed along its own x axis.
TruthFrame truthOf(const ReducedDynamics& dynamics, const StateVector& x) {
  TruthFrame truth;
  truth.state = x;
  const auto ee = dynamics.endEffector(x);
  truth.p_WE = truth.contact_point_W = ee.p_WE;
  const Eigen::Quaterniond q(ee.R_WE);
  truth.quat_WE << q.w(), q.x(), q.y(), q.z();
  truth.contact_force_W = truth.external_force_W =
      rotationFromYawPitchRoll(x[kYaw], 0, 0) * Vector3(3, -1, 2);
  return truth;
}

TEST(HomeFrame, ARobotThatStandsElsewhereAndFacesAnotherWayIsSeenAsTheSame) {
  const ReducedDynamics dynamics(exampleRobot());
  HomeFrame home;
  home.p_WH << 2, -1;
  home.yaw = 1.3;
  for (int i = 0; i < 10; ++i) {
    const StateVector x = randomCase(i).x;
    StateVector elsewhere = x;
    const Matrix3 R_WH = home.R_WH();
    elsewhere.segment<2>(kBallX) = home.pointInW({x[kBallX], x[kBallY], 0}).head<2>();
    elsewhere[kYaw] += home.yaw;
    elsewhere.segment<2>(kPositionDim + kBallVx) =
        R_WH.topLeftCorner<2, 2>() * x.segment<2>(kPositionDim + kBallVx);
    const TruthFrame seen = home.see(truthOf(dynamics, elsewhere)), own = truthOf(dynamics, x);
    EXPECT_LT((seen.state - own.state).norm(), 1e-12);
    EXPECT_LT((seen.p_WE - own.p_WE).norm(), 1e-12);
    EXPECT_NEAR(std::abs(seen.quat_WE.dot(own.quat_WE)), 1, 1e-12);
    EXPECT_LT((seen.contact_force_W - own.contact_force_W).norm(), 1e-12);
    EXPECT_LT((seen.external_force_W - own.external_force_W).norm(), 1e-12);
    EXPECT_LT((seen.contact_point_W - own.contact_point_W).norm(), 1e-12);
  }
}

TEST(HomeFrame, AtTheOriginOfWNoBitChanges) {
  const ReducedDynamics dynamics(exampleRobot());
  const TruthFrame truth = truthOf(dynamics, randomCase(3).x);
  const TruthFrame seen = HomeFrame().see(truth);
  EXPECT_EQ(seen.state, truth.state);
  EXPECT_EQ(seen.p_WE, truth.p_WE);
  EXPECT_EQ(seen.quat_WE, truth.quat_WE);
  EXPECT_EQ(seen.contact_force_W, truth.contact_force_W);
}

}  // namespace
}  // namespace ballbot
