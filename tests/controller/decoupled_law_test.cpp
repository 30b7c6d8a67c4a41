#include "controller/decoupled_law.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "controller/rigid_arm.hpp"
#include "core/error.hpp"
#include "tests/controller/support/closed_loop.hpp"
#include "tests/controller/support/make_law.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

constexpr double kStep = 0.014;

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

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
  for (int i = 0; i < 1000; ++i)
    x.segment<3>(kArm1) = ik.withinLimits(x.segment<3>(kArm1) + 0.01 * ik.rates(x, tasks));
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

std::unique_ptr<ControlLaw> decoupled(const RobotParameters& robot,
                                      const std::string& text = kConfig) {
  const ConfigNode tree = parseYaml(text, "controller.yaml");
  ConfigReader in(tree);
  return test::makeControlLaw(in, robot);
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

/// The ball's way on a robot whose arm is held, from beside its place and with some speed.
std::vector<ClosedLoopSample> withTheArmHeld(ControlLaw& law) {
  const RobotParameters held = withRigidArm(exampleRobot(), exampleRobot().nominal_arm);
  StateVector x = findEquilibrium(ReducedDynamics(held), held.nominal_arm).x;
  x[kBallY] = 0.15;
  x[kPositionDim + kBallVx] = 0.2;
  ClosedLoopOptions options;
  options.noise = 0;
  TrackerConfig tracker;
  tracker.torque_limit.setConstant(held.wheel_torque_limit);
  return runClosedLoop(law, tracker, held, x, 4, options);
}

// The arm that neither moves nor is asked to leaves one problem, and both laws must solve it.
TEST(DecoupledLaw, WithTheArmHeldTheBallMovesAsWithTheWholeBody) {
  std::string text = kConfig;
  text.replace(text.find("ee_position: {weight: 200}"), 26, "arm_position: {weight: 1e5}");
  const auto apart = decoupled(exampleRobot(), text);
  text.replace(text.find("decoupled"), 9, "mpc");
  const auto whole = decoupled(exampleRobot(), text);
  const auto a = withTheArmHeld(*apart), b = withTheArmHeld(*whole);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_NEAR(a.back().time, 4, 1e-3) << "fell";
  double between = 0, farthest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    between = std::max(between, (a[i].x - b[i].x).head<2>().norm());
    farthest = std::max(farthest, a[i].x.head<2>().norm());
  }
  EXPECT_GT(farthest, 0.15);
  EXPECT_LT(between, 2e-3);  // the weight that holds the whole body's arm is finite
  EXPECT_LT(a.back().x.head<2>().norm(), 0.02);
}

TEST(DecoupledLaw, ItsArmIsHeldByItsGravityTorqueWhereverItStands) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 1;
  const auto law = decoupled(robot);
  const ReducedDynamics dynamics(robot);
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  PolicySample out;
  law->sample(kSimStart, out);  // before the first plan
  EXPECT_TRUE(out.torque.tail<3>().isApprox(rest.tau.tail<3>(), 1e-12));
  StateVector x = rest.x;
  x.segment<3>(kArm1) << 0.3, -0.2, 1.8;
  law->plan(kSimStart, x, JointVector::Zero());
  law->activatePlan();
  law->sample(kSimStart, out);
  const VelocityVector h =
      dynamics.nonlinearEffects(x.head<kPositionDim>(), VelocityVector::Zero());
  EXPECT_EQ(out.joint_position.tail<3>(), x.segment<3>(kArm1));
  EXPECT_TRUE(out.torque.tail<3>().isApprox(h.tail<3>(), 1e-12));
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
  x[kArm1 + 1] += 0.05;  // the load makes the arm sag
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
