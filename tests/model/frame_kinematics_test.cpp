#include "model/frame_kinematics.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "model/reduced_dynamics.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/model/sliding_robot.hpp"

namespace ballbot {
namespace {

StateVector someState() {
  StateVector x;
  for (int i = 0; i < kStateDim; ++i) x[i] = 0.4 * std::sin(1 + 2.3 * i);
  return x;
}

TEST(FrameKinematics, AFrameAtTheEndEffectorIsTheEndEffector) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const RobotParameters robot = shape;
    const StateVector x = someState();
    const FrameKinematics frame = frameKinematics(robot, frameOf(robot, "end_effector"), x);
    ReducedDynamics::EndEffectorLinearization tip;
    ReducedDynamics(robot).linearizeEndEffector(x, tip);
    EXPECT_LT((frame.p_WF - tip.value.p_WE).norm(), 1e-14);
    EXPECT_LT((frame.R_WF - tip.value.R_WE).norm(), 1e-14);
    EXPECT_LT((frame.dpose_dq - tip.dpose_dq).norm(), 1e-13);
  }
}

TEST(FrameKinematics, TheJacobianOfAnyFrameIsItsDerivative) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const RobotParameters robot = shape;
    const StateVector x = someState();
    for (const std::string& body : frameBodies(robot)) {
      RobotFrame frame = frameOf(robot, body);
      frame.p_LF += Vector3(0.05, -0.1, 0.2);
      const FrameKinematics at = frameKinematics(robot, frame, x);
      for (int i = 0; i < kPositionDim; ++i) {
        constexpr double h = 1e-6;
        const StateVector step = h * StateVector::Unit(i);
        const FrameKinematics up = frameKinematics(robot, frame, x + step);
        const FrameKinematics down = frameKinematics(robot, frame, x - step);
        const Matrix3 turn = (up.R_WF - down.R_WF) / (2 * h) * at.R_WF.transpose();
        Eigen::Matrix<double, 6, 1> expected;
        expected << (up.p_WF - down.p_WF) / (2 * h), turn(2, 1), turn(0, 2), turn(1, 0);
        EXPECT_LT((at.dpose_dq.col(i) - expected).norm(), 1e-8) << body << ", coordinate " << i;
      }
    }
  }
}

}  // namespace
}  // namespace ballbot
