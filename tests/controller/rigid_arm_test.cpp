#include "controller/rigid_arm.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "controller/mpc_law.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

constexpr int kArmRates = kPositionDim + kArmRate1;

/// What base and ball do while the arm is held: torques of the arm under which it does not
/// accelerate.
VelocityVector accelerationWithTheArmHeld(const ReducedDynamics& dynamics, const PositionVector& q,
                                          const VelocityVector& nu, const Vector3& wheels) {
  JointVector tau = JointVector::Zero();
  tau.head<3>() = wheels;
  const VelocityVector free = dynamics.acceleration(q, nu, tau, Vector3::Zero());
  Matrix3 mobility;
  for (int i = 0; i < 3; ++i) {
    const JointVector more = tau + JointVector::Unit(3 + i);
    mobility.col(i) = (dynamics.acceleration(q, nu, more, Vector3::Zero()) - free).tail<3>();
  }
  tau.tail<3>() = -mobility.inverse() * free.tail<3>();
  return dynamics.acceleration(q, nu, tau, Vector3::Zero());
}

TEST(RigidArm, BaseAndBallMoveAsThoseOfARobotWhoseArmIsHeld) {
  const RobotParameters robot = exampleRobot();
  const Vector3 arm(0.4, -0.9, 1.7);
  const ReducedDynamics whole(robot), rigid(withRigidArm(robot, arm));
  for (int k = 0; k < 20; ++k) {
    RandomCase c = randomCase(k);
    PositionVector q = c.x.head<kPositionDim>();
    VelocityVector nu = c.x.tail<kVelocityDim>();
    q.tail<3>() = arm;
    nu.tail<3>().setZero();
    const VelocityVector expected = accelerationWithTheArmHeld(whole, q, nu, c.tau.head<3>());
    const VelocityVector got = rigid.acceleration(q, nu, c.tau, Vector3::Zero());
    EXPECT_LT((got - expected).head<5>().norm(), 1e-9 * expected.head<5>().norm()) << k;
    EXPECT_TRUE(got.tail<3>().isZero(0)) << k;
  }
}

TEST(RigidArm, NothingReachesTheBaseThroughItsJoints) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics rigid(withRigidArm(robot, robot.nominal_arm));
  for (int k = 0; k < 20; ++k) {
    RandomCase c = randomCase(k);
    c.x.segment<3>(kArmRates).setZero();
    ReducedDynamics::Linearization model;
    rigid.linearize(c.x, c.tau, Vector3::Zero(), model);
    EXPECT_TRUE(model.df_dtau.rightCols<3>().isZero(0)) << k;
    EXPECT_TRUE(model.df_dtau.bottomRows<3>().isZero(0)) << k;
    EXPECT_TRUE(model.df_dx.bottomRows<3>().isZero(0)) << k;
    EXPECT_TRUE((model.df_dx.block<5, 3>(kPositionDim, kArm1).isZero(0))) << k;
  }
}

/// The upper body as one rigid body, from its energies alone: T = 1/2 nu^T M nu and V(yaw, pitch,
/// roll) about rest, nu = (vx, vy, w). Nothing is shared with the Newton-Euler pass.
struct UpperBody {
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  using Matrix5 = Eigen::Matrix<double, 5, 5>;

  UpperBody(const RobotParameters& robot, const Vector3& arm) : robot_(robot) {
    addBody(robot.baseWithWheels(), Matrix3::Identity(), Vector3::Zero());
    Matrix3 R = Matrix3::Identity();
    Vector3 p = Vector3::Zero();
    for (int i = 0; i < kArmJointCount; ++i) {
      p += R * robot.arm[i].p_PJ_P;
      R = R * Eigen::AngleAxisd(arm[i], robot.arm[i].axis);
      addBody(robot.arm[i].inertia, R, p);
    }
    BodyInertia payload;
    payload.mass = robot.payload_mass;
    addBody(payload, R, p + R * robot.p_A3E);
  }

  double potential(const Vector3& yaw_pitch_roll) const {
    const Matrix3 R =
        rotationFromYawPitchRoll(yaw_pitch_roll[0], yaw_pitch_roll[1], yaw_pitch_roll[2]);
    double sum = 0;
    for (const Body& b : bodies_) sum += robot_.gravity * b.mass * (R * b.com).z();
    return sum;
  }

  /// (row i: rate of wheel i relative to the base) = -r/r_w d_i . (kappa - w).
  Eigen::Matrix<double, 3, 5> wheelRates(const Matrix3& R) const {
    Eigen::Matrix<double, 3, 5> rows;
    const Eigen::Matrix<double, 3, 2> kappa = R.transpose() * ballRates();
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector3d d = robot_.wheelAxle(i).transpose();
      rows.row(i) << -d * kappa, d;
    }
    return robot_.ball.radius / robot_.wheels.radius * rows;
  }

  Matrix5 mass(const Matrix3& R) const {
    Matrix5 M = Matrix5::Zero();
    Eigen::Matrix<double, 3, 5> spin;  // of the ball
    spin << ballRates(), Matrix3::Zero();
    M += robot_.ball.inertia * spin.transpose() * spin;
    M.topLeftCorner<2, 2>() += robot_.ball.mass * Eigen::Matrix2d::Identity();
    for (const Body& b : bodies_) {
      Eigen::Matrix<double, 3, 5> v = Eigen::Matrix<double, 3, 5>::Zero();  // of the centre, in W
      v.topLeftCorner<2, 2>().setIdentity();
      for (int k = 0; k < 3; ++k) v.col(2 + k) = R * Vector3::Unit(k).cross(b.com);
      M += b.mass * v.transpose() * v;
      M.bottomRightCorner<3, 3>() += b.inertia;
    }
    const Eigen::Matrix<double, 3, 5> rates = wheelRates(R);
    for (int i = 0; i < 3; ++i) {
      Eigen::Matrix<double, 1, 5> total = rates.row(i);
      total.tail<3>() += robot_.wheelAxle(i).transpose();
      M += robot_.wheels.spin_inertia * total.transpose() * total;
    }
    return M;
  }

 private:
  struct Body {
    double mass;
    Vector3 com;      ///< from K, in B
    Matrix3 inertia;  ///< about it, in B
  };
  void addBody(const BodyInertia& b, const Matrix3& R, const Vector3& origin) {
    bodies_.push_back({b.mass, origin + R * b.p_LLcm_L, R * b.I_LLcm_L * R.transpose()});
  }
  Eigen::Matrix<double, 3, 2> ballRates() const {
    Eigen::Matrix<double, 3, 2> rows;
    rows << 0, -1, 1, 0, 0, 0;
    return rows / robot_.ball.radius;
  }

  RobotParameters robot_;
  std::vector<Body> bodies_;
};

TEST(RigidArm, LinearisedAtRestItIsARigidUpperBodyOnABall) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 1;
  const ReducedDynamics rigid(withRigidArm(robot, robot.nominal_arm));
  const Equilibrium rest = findEquilibrium(rigid, robot.nominal_arm);
  EXPECT_TRUE(rest.tau.isZero(0));
  ReducedDynamics::Linearization model;
  rigid.linearize(rest.x, rest.tau, Vector3::Zero(), model);

  const UpperBody body(robot, robot.nominal_arm);
  const Vector3 angles = rest.x.segment<3>(kYaw);
  const Matrix3 R = rotationFromYawPitchRoll(angles[0], angles[1], angles[2]);
  Matrix3 stiffness;  // second derivative of V, by central differences
  const double h = 1e-4;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vector3 a = h * Vector3::Unit(i), b = h * Vector3::Unit(j);
      stiffness(i, j) = (body.potential(angles + a + b) - body.potential(angles + a - b) -
                         body.potential(angles - a + b) + body.potential(angles - a - b)) /
                        (4 * h * h);
    }
  // Virtual work: the force that belongs to w is T^T times that which belongs to the angles.
  const Matrix3 T = eulerRateMatrix(angles[1], angles[2]);
  Eigen::Matrix<double, 5, 3> by_angles = Eigen::Matrix<double, 5, 3>::Zero();
  by_angles.bottomRows<3>() = -T.transpose() * stiffness;
  const Eigen::Matrix<double, 5, 5> M_inverse = body.mass(R).inverse();

  const Eigen::Matrix<double, 5, 3> A = M_inverse * by_angles;
  const Eigen::Matrix<double, 5, 3> B = M_inverse * body.wheelRates(R).transpose();
  EXPECT_LT((model.df_dx.block<5, 3>(kPositionDim, kYaw) - A).norm(), 1e-5 * A.norm());
  EXPECT_LT((model.df_dtau.block<5, 3>(kPositionDim, 0) - B).norm(), 1e-10 * B.norm());
  EXPECT_TRUE((model.df_dx.block<5, 5>(kPositionDim, kPositionDim).isZero(1e-12)));
}

TEST(RigidArm, KeepsMassAndEquilibriumWithWhatIsInTheHand) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 1;
  const StateVector rest = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  const RobotParameters rigid = withRigidArm(robot, robot.nominal_arm);
  EXPECT_NEAR(rigid.totalMass(), robot.totalMass(), 1e-12);
  EXPECT_NEAR(findEquilibrium(ReducedDynamics(rigid), robot.nominal_arm).x[kPitch], rest[kPitch],
              1e-12);
}

TEST(RigidArm, ItsLqrStabilisesBaseAndBallAndLeavesTheArmAlone) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics rigid(withRigidArm(robot, robot.nominal_arm));
  const LqrSolution lqr = designLqr(rigid, robot.nominal_arm, LqrWeights());
  EXPECT_TRUE(lqr.K.bottomRows<3>().isZero(0));
  for (const int first : {+kArm1, +kArmRates}) {
    EXPECT_TRUE(lqr.K.middleCols<3>(first).isZero(0));
    EXPECT_TRUE(lqr.P.middleRows<3>(first).isZero(0));
  }
  ReducedDynamics::Linearization model;
  rigid.linearize(lqr.equilibrium.x, lqr.equilibrium.tau, Vector3::Zero(), model);
  const StateJacobian closed = model.df_dx + model.df_dtau * lqr.K;
  int still = 0;
  const Eigen::VectorXcd poles = eigenvaluesOf(closed);
  for (const auto& pole : poles) {
    if (pole.real() < -0.5) continue;
    EXPECT_LT(std::abs(pole), 1e-9);  // angles and rates of the arm
    ++still;
  }
  EXPECT_EQ(still, 2 * kArmJointCount);
}

/// The plans of an MPC for the robot with its arm rigid, far from rest.
class RigidArmPlan : public testing::TestWithParam<MpcConfig::Engine> {};

TEST_P(RigidArmPlan, HasNoMotionAndNoTorqueOfTheArm) {
  const RobotParameters rigid = withRigidArm(exampleRobot(), exampleRobot().nominal_arm);
  const ConfigNode tree = parseYaml(R"(
tasks:
  ball_position: {weight: 100}
  ball_velocity: {weight: 10}
  yaw: {weight: 20}
  base_rate: {weight: 4}
  wheel_torque: {weight: 2}
  arm_torque: {weight: 0.05}
)",
                                    "mpc.yaml");
  ConfigReader in(tree);
  MpcConfig config = MpcConfig::read(in, rigid);
  config.engine = GetParam();
  MpcLaw law(rigid, config);
  StateVector x = findEquilibrium(ReducedDynamics(rigid), rigid.nominal_arm).x;
  x[kBallX] = 0.1;
  x[kYaw] = 0.3;
  x[kPitch] += 0.05;
  x[kPositionDim + kOmegaX] = 0.2;
  for (int i = 0; i < 3; ++i) {
    const PlanReport report =
        law.plan(kSimStart + std::chrono::milliseconds(14 * i), x, JointVector::Zero());
    ASSERT_TRUE(report.accepted);
    EXPECT_EQ(report.terms.value[kArmTorqueCost], 0);
    law.activatePlan();
  }
  double wheels = 0;
  for (const MpcPolicy::Control& c : law.activePolicy().controls()) {
    wheels = std::max(wheels, c.u.head<kWheelCount>().norm());
    EXPECT_TRUE(c.u.segment<3>(kWheelCount).isZero(0));
    EXPECT_TRUE(c.K.middleRows<3>(kWheelCount).isZero(0));
    EXPECT_TRUE((c.K.block<kWheelCount, 3>(0, kArm1).isZero(0)));
    EXPECT_TRUE((c.K.block<kWheelCount, 3>(0, kArmRates).isZero(0)));
  }
  EXPECT_GT(wheels, 0.1);
  for (const MpcPolicy::Knot& k : law.activePolicy().knots()) {
    EXPECT_EQ(k.x.segment<3>(kArm1), rigid.nominal_arm);
    EXPECT_TRUE(k.x.segment<3>(kArmRates).isZero(0));
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, RigidArmPlan,
                         testing::Values(MpcConfig::Engine::kDiscrete,
                                         MpcConfig::Engine::kContinuous),
                         [](const auto& test) {
                           return test.param == MpcConfig::Engine::kDiscrete ? "discrete"
                                                                             : "continuous";
                         });

}  // namespace
}  // namespace ballbot
