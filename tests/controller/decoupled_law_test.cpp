#include "controller/decoupled_law.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "controller/frozen_arm.hpp"
#include "controller/law_factory.hpp"
#include "core/error.hpp"
#include "tests/controller/support/allocation_counter.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

constexpr double kStep = 0.014;

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

/// Torques of the arm under which it does not accelerate, and what base and ball do then.
VelocityVector accelerationWithTheArmHeld(const ReducedDynamics& dynamics, const PositionVector& q,
                                          const VelocityVector& nu, const Vector3& wheels) {
  JointVector tau = JointVector::Zero();
  tau.head<3>() = wheels;
  const VelocityVector free = dynamics.acceleration(q, nu, tau, Vector3::Zero());
  Matrix3 mobility;
  for (int i = 0; i < 3; ++i) {
    mobility.col(i) = (dynamics.acceleration(q, nu, tau + JointVector::Unit(3 + i), Vector3::Zero()) - free).tail<3>();
  }
  tau.tail<3>() = -mobility.inverse() * free.tail<3>();
  return dynamics.acceleration(q, nu, tau, Vector3::Zero());
}

TEST(FrozenArm, BaseAndBallAccelerateAsThoseOfARobotWhoseArmIsHeld) {
  const RobotParameters robot = exampleRobot();
  const Vector3 arm(0.4, -0.9, 1.7);
  const ReducedDynamics whole(robot), frozen(withFrozenArm(robot, arm));
  for (int k = 0; k < 20; ++k) {
    const RandomCase c = randomCase(k);
    PositionVector q = c.x.head<kPositionDim>();
    q.tail<3>() = arm;
    const VelocityVector rest = VelocityVector::Zero();
    JointVector wheels = JointVector::Zero();
    wheels.head<3>() = c.tau.head<3>();
    const VelocityVector expected = accelerationWithTheArmHeld(whole, q, rest, c.tau.head<3>());
    const VelocityVector got = frozen.acceleration(q, rest, wheels, Vector3::Zero());
    EXPECT_LT((got - expected).head<5>().norm(), 1e-8 * expected.head<5>().norm()) << k;
  }
}

TEST(FrozenArm, KeepsMassAndEquilibriumWithWhatIsInTheHand) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 1;
  const double mass = robot.totalMass();
  const StateVector rest = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  const RobotParameters frozen = withFrozenArm(robot, robot.nominal_arm);
  EXPECT_NEAR(frozen.totalMass(), mass, 1e-8);
  EXPECT_NEAR(findEquilibrium(ReducedDynamics(frozen), robot.nominal_arm).x[kPitch], rest[kPitch], 1e-9);
}

Tasks asking(const ReducedDynamics& dynamics, const StateVector& x, const Vector3& by) {
  Tasks tasks;
  tasks.ee_position_weight.setConstant(200);
  const auto ee = dynamics.endEffector(x);
  tasks.p_WE = ee.p_WE + by;
  tasks.R_WE = ee.R_WE;
  return tasks;
}

TEST(ArmInverseKinematics, LeadsTheEndEffectorToItsReferenceOnAStandingBase) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  const ArmInverseKinematics ik(robot, {});
  StateVector x = findEquilibrium(dynamics, robot.nominal_arm).x;
  const Tasks tasks = asking(dynamics, x, {0.08, 0.05, -0.1});
  const double before = (dynamics.endEffector(x).p_WE - tasks.p_WE).norm();
  for (int i = 0; i < 600; ++i) {
    const Vector3 rates = ik.rates(x, tasks);
    ASSERT_LE(rates.cwiseAbs().maxCoeff(), 1 + 1e-12);  // its limit
    x.segment<3>(kArm1) = ik.withinLimits(x.segment<3>(kArm1) + 0.01 * rates);
  }
  EXPECT_LT((dynamics.endEffector(x).p_WE - tasks.p_WE).norm(), 0.01 * before);
}

TEST(ArmInverseKinematics, StaysFiniteAndInsideLimitsWhereThePlaceCannotBeReached) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  const ArmInverseKinematics ik(robot, {});
  StateVector x = findEquilibrium(dynamics, robot.nominal_arm).x;
  const Tasks tasks = asking(dynamics, x, {2, 1, 1});
  for (int i = 0; i < 1000; ++i) x.segment<3>(kArm1) = ik.withinLimits(x.segment<3>(kArm1) + 0.01 * ik.rates(x, tasks));
  ASSERT_TRUE(x.allFinite());
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(x[kArm1 + i], robot.arm[i].lower_limit);
    EXPECT_LE(x[kArm1 + i], robot.arm[i].upper_limit);
  }
}

TEST(ArmInverseKinematics, WithoutAnEndEffectorTaskLeadsToTheArmsOwnReference) {
  const RobotParameters robot = exampleRobot();
  StateVector x = StateVector::Zero();
  x.segment<3>(kArm1) << 0.1, -0.5, 2;
  Tasks tasks;
  tasks.arm_position << 0.1, -0.6, 2;
  const Vector3 rates = ArmInverseKinematics(robot, {}).rates(x, tasks);
  EXPECT_NEAR(rates[1], 4 * -0.1, 1e-12);
  EXPECT_EQ(rates[0], 0);
}

const char* const kConfig = R"(
kind: decoupled
mpc:
  tasks:
    ball_position: {weight: 100}
    ball_velocity: {weight: 10}
    ee_position: {weight: 200}
    yaw: {weight: 20}
    base_rate: {weight: 4}
    wheel_torque: {weight: 2}
    arm_torque: {weight: 0.05}
decoupled:
  pid: {stiffness_Nm_per_rad: 100}
)";

std::unique_ptr<ControlLaw> decoupled(const RobotParameters& robot, const std::string& text = kConfig) {
  const ConfigNode tree = parseYaml(text, "controller.yaml");
  ConfigReader in(tree);
  return makeControlLaw(in, robot);
}

TEST(DecoupledLaw, TheBaseDoesNotNoticeWhatTheArmDoes) {
  const RobotParameters robot = exampleRobot();
  StateVector x = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  x[kPitch] += 0.02;
  PolicySample still, moving;
  for (PolicySample* out : {&still, &moving}) {
    const auto law = decoupled(robot);
    law->plan(kSimStart, x, JointVector::Zero());
    law->activatePlan();
    law->sample(at(0.005), *out);
    x.segment<3>(kArm1) << 0.5, 0.3, 1;
    x.segment<3>(kPositionDim + kArmRate1) << 1, -2, 1;
  }
  EXPECT_EQ(still.torque.head<3>(), moving.torque.head<3>());
  EXPECT_TRUE(moving.feedback.topRows<3>().middleCols<3>(kArm1).isZero(0));
  EXPECT_GT(still.torque.head<3>().norm(), 0.01);
}

TEST(DecoupledLaw, TheArmNoticesTheBaseOnlyWhereAskedTo) {
  const RobotParameters robot = exampleRobot();
  const StateVector rest = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  StateVector rolled = rest;
  rolled[kBallX] += 0.1;
  const auto armRates = [&](const StateVector& x, const std::string& base) {
    const auto law = decoupled(robot, kConfig + ("  inverse_kinematics: {base: " + base + "}\n"));
    law->plan(kSimStart, x, JointVector::Zero());
    law->activatePlan();
    PolicySample out;
    law->sample(kSimStart, out);
    return Vector3(out.joint_velocity.tail<3>());
  };
  EXPECT_EQ(armRates(rest, "task"), armRates(rolled, "task"));
  EXPECT_GT((armRates(rest, "estimated") - armRates(rolled, "estimated")).norm(), 0.01);
}

TEST(DecoupledLaw, ItsIntegralTakesUpALoadNobodyToldItOf) {
  const RobotParameters robot = exampleRobot();
  const auto law = decoupled(robot);
  StateVector x = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  PolicySample first, later;
  law->plan(kSimStart, x, JointVector::Zero());
  law->activatePlan();
  law->sample(kSimStart, first);
  x[kArm2] += 0.05;  // the load makes the arm sag
  for (int i = 1; i <= 20; ++i) law->plan(at(kStep * i), x, JointVector::Zero());
  law->activatePlan();
  law->sample(at(kStep * 20), later);
  EXPECT_LT(later.torque[kWheelCount + 1], first.torque[kWheelCount + 1] - 0.5);
}

TEST(DecoupledLaw, ARestoredStateContinuesBitForBit) {
  const RobotParameters robot = exampleRobot();
  const auto law = decoupled(robot), other = decoupled(robot);
  StateVector x = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  x[kRoll] += 0.02;
  for (int i = 0; i < 5; ++i) {
    law->plan(at(kStep * i), x, JointVector::Zero());
    law->activatePlan();
  }
  other->restoreState(law->saveState());
  PolicySample a, b;
  for (ControlLaw* l : {law.get(), other.get()}) {
    l->plan(at(kStep * 5), x, JointVector::Zero());
    l->activatePlan();
    l->sample(at(kStep * 5.5), l == law.get() ? a : b);
  }
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.feedback, b.feedback);
}

TEST(DecoupledLaw, PlanAndSampleDoNotAllocate) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  const RobotParameters robot = exampleRobot();
  const auto law = decoupled(robot);
  const StateVector x = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x;
  law->plan(kSimStart, x, JointVector::Zero());
  law->activatePlan();
  PolicySample out;
  const std::int64_t before = allocationCount();
  for (int i = 1; i <= 3; ++i) {
    law->plan(at(kStep * i), x, JointVector::Zero());
    law->activatePlan();
    law->sample(at(kStep * i), out);
    law->commanded(at(kStep * i), std::chrono::microseconds(400), out.torque);
  }
  EXPECT_EQ(allocationCount(), before);
}

TEST(DecoupledLaw, RefusesAnUnknownKeyOfItsOwn) {
  std::string text = kConfig;
  text.replace(text.find("stiffness_Nm_per_rad"), 20, "stifness_Nm_per_rad");
  try {
    decoupled(exampleRobot(), text);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("did you mean 'stiffness_Nm_per_rad'"));
  }
}

}  // namespace
}  // namespace ballbot
