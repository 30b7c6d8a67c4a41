#include "model/contact_momentum.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "model/body_poses.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr int kRandomStates = 100;

class ContactMomentumTest : public ::testing::Test {
 protected:
  ReducedDynamics dynamics{exampleRobot()};
};

// The equations of motion know nothing of H: whatever the drives do, and however the robot moves.
TEST_F(ContactMomentumTest, ChangesByGravityAndByWhatPushesAlone) {
  for (int i = 0; i < kRandomStates; ++i) {
    const RandomCase c = randomCase(i);
    const StateVector dx = dynamics.derivative(c.x, c.tau, c.lambda);
    const double step = 1e-4;
    const auto slope = [&](double h) {
      const auto at = [&](const StateVector& x) {
        Vector3 values;
        values << contactMomentum(dynamics, x),
            gravityAboutContact(dynamics, x.head<kPositionDim>()).height_moment;
        return values;
      };
      return Vector3((at(c.x + h * dx) - at(c.x - h * dx)) / (2 * h));
    };
    const Vector3 rate = (4 * slope(step / 2) - slope(step)) / 3;
    const Eigen::Vector2d v = c.x.segment<2>(kPositionDim);
    const Vector3 p_WE = dynamics.endEffector(c.x).p_WE;
    const Vector3 arm_WP(p_WE.x() - c.x[kBallX], p_WE.y() - c.x[kBallY], p_WE.z());
    const Eigen::Vector2d expected =
        gravityAboutContact(dynamics, c.x.head<kPositionDim>()).moment_W -
        Eigen::Vector2d(v.y() * rate.z(), -v.x() * rate.z()) + arm_WP.cross(c.lambda).head<2>();
    const Eigen::Vector2d got = rate.head<2>();
    EXPECT_LT((got - expected).norm(), 1e-6 * (1 + expected.norm())) << "case " << i;
  }
}

// By hand: sum over the bodies of p x m v + I w, for one that turns about P as a whole.
TEST_F(ContactMomentumTest, IsThatOfTheBodiesOneByOne) {
  const RobotParameters& robot = dynamics.robot();
  for (int i = 0; i < kRandomStates; ++i) {
    StateVector x = randomCase(i).x;
    // No wheel and no joint turns: v = r w x z for the ball, and one angular velocity for all.
    const Matrix3 R_WB = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
    Vector3 w = R_WB * x.segment<3>(kPositionDim + kOmegaX);
    w.z() = 0;
    x.segment<3>(kPositionDim + kOmegaX) = R_WB.transpose() * w;
    x.segment<2>(kPositionDim) = robot.ball.radius * w.cross(Vector3::UnitZ()).head<2>();
    x.tail<kArmJointCount>().setZero();

    const Vector3 p_WP(x[kBallX], x[kBallY], 0);
    Vector3 H = (robot.ball.inertia + robot.ball.mass * robot.ball.radius * robot.ball.radius) * w;
    double height_moment = robot.ball.mass * robot.ball.radius;
    Vector3 first = robot.ball.mass * Vector3(0, 0, robot.ball.radius);
    const auto add = [&](const BodyInertia& body, const BodyPose& pose) {
      const Vector3 c = pose.p_WL + pose.R_WL * body.p_LLcm_L - p_WP;
      H += c.cross(body.mass * w.cross(c)) + pose.R_WL * body.I_LLcm_L * pose.R_WL.transpose() * w;
      first += body.mass * c;
      height_moment += body.mass * c.z();
    };
    const auto poses = bodyPoses(robot, x);
    BodyInertia base = robot.baseWithWheels();
    for (int k = 0; k < kWheelCount; ++k) {
      const Vector3 d = robot.wheelAxle(k);
      base.I_LLcm_L += robot.wheels.spin_inertia * d * d.transpose();
    }
    add(base, poses[0]);
    add(robot.arm[0].inertia, poses[1]);
    add(robot.arm[1].inertia, poses[2]);
    add(robot.lastLinkWithPayload(), poses[3]);

    const GravityAboutContact gravity = gravityAboutContact(dynamics, x.head<kPositionDim>());
    EXPECT_LT((contactMomentum(dynamics, x) - H.head<2>()).norm(), 1e-9 * (1 + H.norm()))
        << "case " << i;
    EXPECT_NEAR(gravity.height_moment, height_moment, 1e-10);
    const Vector3 moment = first.cross(Vector3(0, 0, -robot.gravity));
    EXPECT_LT((gravity.moment_W - moment.head<2>()).norm(), 1e-9) << "case " << i;
  }
}

}  // namespace
}  // namespace ballbot
