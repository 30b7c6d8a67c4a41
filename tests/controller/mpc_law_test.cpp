#include "controller/mpc_law.hpp"

#include <cmath>
#include <limits>
#include <thread>

#include <gmock/gmock.h>

#include "controller/background_mpc_law.hpp"
#include "core/error.hpp"
#include "tests/controller/support/closed_loop.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

const char* const kEndEffectorTasks =
    "mpc.tasks={ee_position: {weight: [400, 400, 0], reference: {moves: ["
    "  {at_s: 2, by: [0.3, 0, 0]}, {at_s: 6, by: [0, 0.3, 0]}]}},"
    "ee_orientation: {weight: 20}, ee_velocity: {weight: 4}, ee_rate: {weight: 0.5},"
    "yaw: {weight: 20}, arm_rate: {weight: 0.2}, base_rate: {weight: 4},"
    "wheel_torque: {weight: 2}, arm_torque: {weight: 0.05}}";

class MpcLawTest : public testing::Test {
 protected:
  MpcConfig config() {
    ConfigReader in(tree_);
    ConfigReader mpc = in.child("mpc");
    return MpcConfig::read(mpc, robot_);
  }
  TrackerConfig tracker() {
    ConfigReader in(tree_);
    ConfigReader tracker = in.child("tracker");
    return TrackerConfig::read(tracker, robot_);
  }
  StateVector atRest() const {
    return findEquilibrium(ReducedDynamics(robot_), robot_.nominal_arm).x;
  }
  JointVector jointsAtRest() const {
    JointVector q = JointVector::Zero();
    q.tail<kArmJointCount>() = robot_.nominal_arm;
    return q;
  }

  RobotParameters robot_ = exampleRobot();
  ConfigNode tree_ = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/controllers/mpc.yaml");
};

TEST_F(MpcLawTest, LeansAgainstAPushAndReturns) {
  MpcLaw law(robot_, config());
  ClosedLoopOptions options;
  options.latency_steps = 30;  // 12 ms
  options.push = [](double t) { return t >= 1 && t < 1.5 ? Vector3(0, 20, 0) : Vector3(0, 0, 0); };
  const auto run = runClosedLoop(law, tracker(), robot_, atRest(), 8, options);
  ASSERT_NEAR(run.back().time, 8, 1e-3) << "fell";
  double excursion = 0, tilt = 0;
  for (const auto& s : run) {
    excursion = std::max(excursion, s.x.head<2>().norm());
    tilt = std::max(tilt, s.tilt);
    if (s.time < 5.5) continue;
    ASSERT_LT(s.x.head<2>().norm(), 0.05) << "at " << s.time << " s";
  }
  EXPECT_LT(excursion, 0.45);
  EXPECT_GT(tilt, 5 * M_PI / 180);
  EXPECT_LT(tilt, 10 * M_PI / 180);
  EXPECT_EQ(law.failedPlans(), 0);
}

TEST_F(MpcLawTest, MovesTheEndEffectorWithTheBallFirstGoingTheOtherWay) {
  applyOverride(tree_, kEndEffectorTasks);
  MpcLaw law(robot_, config());
  const auto run = runClosedLoop(law, tracker(), robot_, atRest(), 10);
  ASSERT_NEAR(run.back().time, 10, 1e-3) << "fell";
  const ReducedDynamics dynamics(robot_);
  const Vector3 start = dynamics.endEffector(atRest()).p_WE;
  double lowest_ball_x = 0, largest_x = 0;
  for (const auto& s : run) {
    const Vector3 moved = dynamics.endEffector(s.x).p_WE - start;
    if (s.time < 3) lowest_ball_x = std::min(lowest_ball_x, s.x[kBallX]);
    largest_x = std::max(largest_x, moved.x());
    if (s.time > 5.5 && s.time < 5.9) {
      EXPECT_NEAR(moved.x(), 0.3, 0.015);
      EXPECT_NEAR(moved.y(), 0, 0.015);
    }
    if (s.time > 9.5) {
      EXPECT_NEAR(moved.x(), 0.3, 0.015);
      EXPECT_NEAR(moved.y(), 0.3, 0.015);
    }
  }
  EXPECT_LT(lowest_ball_x, -0.01);
  EXPECT_LT(largest_x, 0.34);
}

TEST_F(MpcLawTest, TheContinuousEngineHoldsTheRobotToo) {
  applyOverride(tree_, "mpc.engine=continuous");
  MpcLaw law(robot_, config());
  StateVector x0 = atRest();
  x0[kPitch] += 0.05;
  const auto run = runClosedLoop(law, tracker(), robot_, x0, 2);
  ASSERT_NEAR(run.back().time, 2, 1e-3) << "fell";
  EXPECT_LT(run.back().tilt, 0.05);
  EXPECT_EQ(law.failedPlans(), 0);
}

TEST_F(MpcLawTest, FallsBackToTheLqrWithoutPlansAndReturnsWithThem) {
  MpcLaw law(robot_, config());
  const StateVector x = atRest();
  const JointVector joints = jointsAtRest();
  const auto at = [](int ms) { return simTimeFromNs(ms * 1'000'000LL); };
  ASSERT_TRUE(law.plan(at(0), x, joints).accepted);
  law.activatePlan();
  PolicySample mpc, lqr, again;
  law.sample(at(0), mpc);

  StateVector lost = x;
  lost[kYaw] = std::numeric_limits<double>::quiet_NaN();
  for (int ms = 14; ms <= 154; ms += 14) {
    const PlanReport report = law.plan(at(ms), lost, joints);
    EXPECT_FALSE(report.accepted);
    EXPECT_EQ(report.status, PlanStatus::kStateNotFinite);
    EXPECT_STREQ(planStatusName(report.status), "state not finite");
    EXPECT_EQ(report.fallback, ms > 100) << ms;
    law.activatePlan();
  }
  law.sample(at(160), lqr);
  EXPECT_TRUE(lqr.feedback.allFinite());
  LqrLawConfig lqr_config;
  lqr_config.set_point.arm = robot_.nominal_arm;
  EXPECT_LT((lqr.feedback - LqrLaw(robot_, lqr_config).solution().K).norm(), 1e-9);
  EXPECT_EQ(law.failedPlans(), 11);

  ASSERT_TRUE(law.plan(at(168), x, joints).accepted);
  law.activatePlan();
  law.sample(at(168), again);
  EXPECT_LT((again.feedback - mpc.feedback).norm(), 0.1 * mpc.feedback.norm());
}

TEST_F(MpcLawTest, AProblemThatIsNotFiniteIsRefusedAndTheRobotStaysUp) {
  MpcConfig c = config();
  auto schedule = std::make_shared<TaskSchedule>(*c.schedule);
  schedule->ball_position.step(1,
                               Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  c.schedule = schedule;
  MpcLaw law(robot_, c);
  const auto run = runClosedLoop(law, tracker(), robot_, atRest(), 5);
  ASSERT_NEAR(run.back().time, 5, 1e-3) << "fell";
  for (const auto& s : run) {
    ASSERT_LT(s.x.head<2>().norm(), 0.15) << "at " << s.time << " s";
    if (s.time > 1.02) {
      ASSERT_FALSE(s.plan.accepted);
      ASSERT_EQ(s.plan.status, PlanStatus::kNotFinite);
    }
    if (s.time > 1.15) {
      ASSERT_TRUE(s.plan.fallback) << "at " << s.time << " s";
    }
  }
  EXPECT_NEAR(static_cast<double>(law.failedPlans()), 4 / 0.014, 2);
}

TEST_F(MpcLawTest, WithoutAnyPlanTheLqrStandsInFromTheFirstRefusalAndHoldsThePlace) {
  MpcConfig c = config();
  auto schedule = std::make_shared<TaskSchedule>(*c.schedule);
  schedule->ball_position.step(0,
                               Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  c.schedule = schedule;
  MpcLaw law(robot_, c);
  StateVector x0 = atRest();
  x0[kBallX] = 2;
  ClosedLoopOptions options;
  options.push = [](double t) { return t >= 1 && t < 1.5 ? Vector3(10, 0, 0) : Vector3(0, 0, 0); };
  const auto run = runClosedLoop(law, tracker(), robot_, x0, 12, options);
  ASSERT_NEAR(run.back().time, 12, 1e-3) << "fell";
  double excursion = 0;
  for (const auto& s : run) {
    ASSERT_TRUE(s.plan.fallback) << "at " << s.time << " s";
    excursion = std::max(excursion, s.x[kBallX] - 2);
  }
  EXPECT_GT(excursion, 0.1);
  EXPECT_NEAR(run.back().x[kBallX], 2, 0.05) << "it comes back to where it was";
  EXPECT_NEAR(run.back().x[kBallY], 0, 0.05);
  PolicySample sample;
  law.sample(simTimeFromNs(12'000'000'000), sample);
  EXPECT_TRUE(sample.from_stand_in);
}

TEST_F(MpcLawTest, PlansFromTheFirstForAnArmThatPointsUpOrIsLight) {
  RobotParameters up = robot_, light = robot_;
  up.nominal_arm.setZero();
  for (ArmLink& link : light.arm) {
    link.inertia.mass /= 10;
    link.inertia.I_LLcm_L /= 10;
  }
  for (const RobotParameters& robot : {up, light}) {
    robot_ = robot;
    for (const char* horizon :
         {"{length_s: 1, step_ms: 20}",
          "{length_s: 1, step_ms: 40, fine_length_s: 0.2, fine_step_ms: 10}"}) {
      applyOverride(tree_, std::string("mpc.horizon=") + horizon);
      MpcLaw law(robot, config());
      StateVector x0 = atRest();
      x0[kPitch] += 0.05;
      const auto run = runClosedLoop(law, tracker(), robot, x0, 3);
      ASSERT_NEAR(run.back().time, 3, 1e-3) << "fell";
      EXPECT_EQ(law.failedPlans(), 0) << horizon;
      EXPECT_LT(run.back().tilt, 0.05);
    }
  }
}

TEST_F(MpcLawTest, StaysUpWhileNobodyPlans) {
  // From 1 s to 4 s no plan is made; the LQR has to keep the robot up and where it is.
  class Interrupted final : public ControlLaw {
   public:
    explicit Interrupted(MpcLaw& law) : law_(law) {}
    PlanReport plan(SimTime now, const StateVector& x, const JointVector& q) noexcept override {
      if (toSeconds(now) < 1 || toSeconds(now) > 4) return law_.plan(now, x, q);
      return PlanReport{};
    }
    void activatePlan() noexcept override { law_.activatePlan(); }
    void sample(SimTime now, PolicySample& out) const noexcept override { law_.sample(now, out); }
    void commanded(SimTime now, SimDuration h, const JointVector& tau) noexcept override {
      law_.commanded(now, h, tau);
    }
    StateBlob saveState() const override { return law_.saveState(); }
    void restoreState(const StateBlob& blob) override { law_.restoreState(blob); }

   private:
    MpcLaw& law_;
  };
  MpcLaw law(robot_, config());
  Interrupted interrupted(law);
  const auto run = runClosedLoop(interrupted, tracker(), robot_, atRest(), 6);
  ASSERT_NEAR(run.back().time, 6, 1e-3) << "fell";
  for (const auto& s : run) ASSERT_LT(s.x.head<2>().norm(), 0.15) << "at " << s.time << " s";
}

TEST_F(MpcLawTest, ContinuesBitForBitFromASavedState) {
  MpcLaw law(robot_, config()), other(robot_, config());
  StateVector x = atRest();
  const JointVector joints = jointsAtRest();
  const auto at = [](int ms) { return simTimeFromNs(ms * 1'000'000LL); };
  x[kBallX] = 0.1;
  law.plan(at(0), x, joints);
  law.activatePlan();
  law.commanded(at(0), std::chrono::microseconds(400), JointVector::Constant(0.7));
  law.plan(at(14), x, joints);  // pending when saved
  other.restoreState(law.saveState());
  for (MpcLaw* l : {&law, &other}) {
    l->activatePlan();
    l->commanded(at(14), std::chrono::microseconds(400), JointVector::Constant(-0.2));
    ASSERT_TRUE(l->plan(at(28), x, joints).accepted);
    l->activatePlan();
  }
  PolicySample a, b;
  law.sample(at(31), a);
  other.sample(at(31), b);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.feedback, b.feedback);
  EXPECT_EQ(a.joint_position, b.joint_position);
  EXPECT_EQ(law.saveState(), other.saveState());
}

TEST_F(MpcLawTest, RefusesAPlanOfAnotherHorizonAndStaysAsItWas) {
  const MpcLaw law(robot_, config());
  applyOverride(tree_, "mpc.horizon.length_s=0.8");
  MpcLaw shorter(robot_, config());
  const StateBlob before = shorter.saveState();
  try {
    shorter.restoreState(law.saveState());
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("knots of a plan where this one has"));
  }
  EXPECT_EQ(shorter.saveState(), before);
}

TEST_F(MpcLawTest, NoCallOfTheControlStepAllocates) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  applyOverride(tree_, "mpc.contact_forces=true");
  applyOverride(tree_, "mpc.contact_moments=true");
  MpcLaw law(robot_, config());
  const StateVector x = atRest();
  const JointVector joints = jointsAtRest();
  PolicySample sample;
  const PdTracker pd(tracker());
  ActuatorCommand command;
  const auto before = allocationCount();
  bool accepted = true;
  for (int i = 0; i < 10; ++i) {
    const SimTime now = simTimeFromNs(i * 14'000'000LL);
    Circumstances touched;
    touched.contact_force_W = Vector3(-3, 0, 0);
    law.setCircumstances(touched);
    accepted = law.plan(now, x, joints).accepted && accepted;
    law.activatePlan();
    law.sample(now, sample);
    accepted =
        pd.step(sample, x, joints, JointVector::Zero(), command) == TrackStatus::kOk && accepted;
    law.commanded(now, std::chrono::microseconds(400), sample.torque);
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_TRUE(accepted);
}

TEST_F(MpcLawTest, WheelSetPointsStartAtTheMeasuredAngleAndMoveAsThePlanRolls) {
  MpcLaw law(robot_, config());
  StateVector x = atRest();
  x[kPositionDim + kBallVx] = 0.2;
  JointVector joints = jointsAtRest();
  joints.head<3>() << 5, -7, 2;
  ASSERT_TRUE(law.plan(kSimStart, x, joints).accepted);
  law.activatePlan();
  const ReducedDynamics dynamics(robot_);
  PolicySample now, later;
  law.sample(kSimStart, now);
  law.sample(simTimeFromNs(1'000'000), later);
  const JointVector rate =
      dynamics.selectionMatrix(x.head<kPositionDim>()) * x.tail<kVelocityDim>();
  EXPECT_LT((now.joint_position - joints).norm(), 1e-12);
  EXPECT_LT((now.joint_velocity - rate).norm(), 1e-12);
  EXPECT_LT(((later.joint_position - now.joint_position) / 1e-3 - rate).norm(), 0.2 * rate.norm());
}

TEST_F(MpcLawTest, SolvedInAThreadOfItsOwnGivesThePlanOfTheLockstepLaw) {
  applyOverride(tree_, "mpc.solver_thread=true");
  BackgroundMpcLaw background(robot_, config());
  MpcLaw lockstep(robot_, config());
  const StateVector x = atRest();
  const JointVector joints = jointsAtRest();
  background.plan(kSimStart, x, joints);
  for (int i = 0; background.solves() == 0 && i < 10000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_EQ(background.solves(), 1);
  lockstep.plan(kSimStart, x, joints);
  background.activatePlan();
  lockstep.activatePlan();
  PolicySample a, b;
  background.sample(simTimeFromNs(3'000'000), a);
  lockstep.sample(simTimeFromNs(3'000'000), b);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.feedback, b.feedback);
}

TEST_F(MpcLawTest, ALawThatSolvesInAThreadCannotBeSaved) {
  BackgroundMpcLaw law(robot_, config());
  try {
    law.saveState();
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("mpc.solver_thread: true cannot be saved"));
  }
}

}  // namespace
}  // namespace ballbot
