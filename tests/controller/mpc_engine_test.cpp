#include "controller/mpc_engine.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "controller/mpc_planner.hpp"
#include "tests/controller/support/lqr_seed.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/allocation_counter.hpp"

namespace ballbot {
namespace {

TimedWeight<3> three(double w) { return TimedWeight<3>(Vector3::Constant(w)); }
TimedWeight<2> two(double w) { return TimedWeight<2>(Eigen::Vector2d::Constant(w)); }
TimedWeight<1> one(double w) { return TimedWeight<1>(Eigen::Matrix<double, 1, 1>(w)); }

struct TaskCase {
  const char* name;
  bool contact;
  std::function<void(TaskSchedule&)> set;
};

class MpcEngineTest : public testing::Test {
 protected:
  explicit MpcEngineTest() : config_(robot_) {
    config_.horizon.length = 0.6;
    config_.shaping = {40, 200};
    x0_ << lqr_.equilibrium.x, Vector3(0.5, -0.3, 0.2);
    x0_[kBallX] = 0.05;
    x0_[kBallY] = -0.03;
    x0_[kPitch] += 0.04;
    x0_[kYaw] = 0.1;
    x0_[kArm1] = 0.15;
    x0_[kPositionDim + kOmegaX] = 0.2;
    x0_[kPositionDim + kArmRate1 + 1] = -0.3;
  }
  /// What every case has: a cost of torques and rates, or the problem has no unique solution.
  TaskSchedule regularised() const {
    TaskSchedule s(robot_);
    s.base_rate_weight = three(4);
    s.arm_rate_weight = three(0.5);
    s.wheel_torque_weight = one(2);
    s.arm_torque_weight = one(0.1);
    s.yaw_weight = one(5);
    return s;
  }
  MpcSolveReport converged(MpcConfig::Engine kind, double step, MpcPolicy* plan = nullptr) {
    config_.engine = kind;
    config_.horizon.coarse_step = step;
    const auto engine = makeEngine(robot_, config_);
    MpcPolicy out = engine->emptyPolicy();
    const MpcSolveReport report = engine->solve(kSimStart, x0_, lqrSeed(*engine, lqr_), 60, out);
    if (plan) *plan = out;
    return report;
  }

  RobotParameters robot_ = exampleRobot();
  LqrSolution lqr_ = designLqr(ReducedDynamics(robot_), robot_.nominal_arm, LqrWeights{});
  MpcConfig config_;
  MpcState x0_;
};

TEST_F(MpcEngineTest, DiscreteAndContinuousConvergeToTheSameCostOnEveryTask) {
  const TaskCase cases[] = {
      {"ee_position", false,
       [](TaskSchedule& s) {
         s.ee_position_weight = three(400);
         s.ee_position.step(0, Vector3(0.1, 0.05, 0.02));
       }},
      {"ee_orientation", false,
       [](TaskSchedule& s) {
         s.ee_orientation_weight = three(20);
         s.ee_orientation.step(0, Vector3(0.2, 0.1, 0));
       }},
      {"ee_twist", false,
       [](TaskSchedule& s) {
         s.ee_velocity_weight = three(40);
         s.ee_rate_weight = three(5);
       }},
      {"ball_position", false,
       [](TaskSchedule& s) {
         s.ball_position_weight = two(100);
         s.ball_velocity_weight = two(10);
       }},
      {"arm_position", false, [](TaskSchedule& s) { s.arm_position_weight = three(20); }},
      {"contact_force", true,
       [](TaskSchedule& s) {
         s.ee_position_weight = three(100);
         s.contact_force_weight = three(1);
         s.contact_force = TimeSignal<3>(Vector3(0, 0, 5));
       }},
      {"all", true,
       [](TaskSchedule& s) {
         s.ee_position_weight = three(400);
         s.ee_orientation_weight = three(20);
         s.ee_velocity_weight = three(4);
         s.ball_position_weight = two(10);
         s.contact_force_weight = three(1);
         s.contact_force = TimeSignal<3>(Vector3(0, 0, 5));
       }},
  };
  for (const TaskCase& c : cases) {
    TaskSchedule schedule = regularised();
    c.set(schedule);
    config_.schedule = std::make_shared<TaskSchedule>(schedule);
    config_.contact_forces = c.contact;
    const MpcSolveReport discrete = converged(MpcConfig::Engine::kDiscrete, 0.0025);
    const MpcSolveReport continuous = converged(MpcConfig::Engine::kContinuous, 0.01);
    ASSERT_EQ(discrete.status, SlqStatus::kConverged) << c.name;
    ASSERT_TRUE(continuous.ok()) << c.name;
    EXPECT_NEAR(discrete.cost, continuous.cost, 1e-3 * continuous.cost) << c.name;
    for (int i = 0; i < kCostTermCount; ++i) {
      EXPECT_NEAR(discrete.terms.value[i], continuous.terms.value[i], 5e-3 * continuous.cost)
          << c.name << ": " << costTermName(CostTerm(i));
    }
  }
}

TEST_F(MpcEngineTest, BothEnginesPlanTheSameMotion) {
  TaskSchedule schedule = regularised();
  schedule.ball_position_weight = two(100);
  schedule.ball_velocity_weight = two(10);
  schedule.ee_orientation_weight = three(20);
  config_.schedule = std::make_shared<TaskSchedule>(schedule);
  MpcPolicy discrete, continuous;
  ASSERT_TRUE(converged(MpcConfig::Engine::kDiscrete, 0.005, &discrete).ok());
  ASSERT_TRUE(converged(MpcConfig::Engine::kContinuous, 0.01, &continuous).ok());
  for (double t = 0; t <= 0.6; t += 0.05) {
    const MpcState difference = discrete.stateAt(t) - continuous.stateAt(t);
    EXPECT_LT(difference.head<kPositionDim>().cwiseAbs().maxCoeff(), 3e-3) << "at " << t << " s";
    EXPECT_LT(difference.segment<kVelocityDim>(kPositionDim).cwiseAbs().maxCoeff(), 0.05) << t;
  }
}

TEST_F(MpcEngineTest, AGradedGridPlansNearlyWhatAFineOneDoes) {
  TaskSchedule schedule = regularised();
  schedule.ball_position_weight = two(100);
  config_.schedule = std::make_shared<TaskSchedule>(schedule);
  const MpcSolveReport fine = converged(MpcConfig::Engine::kDiscrete, 0.01);
  config_.horizon.fine_length = 0.2;
  config_.horizon.fine_step = 0.01;
  const MpcSolveReport graded = converged(MpcConfig::Engine::kDiscrete, 0.02);
  EXPECT_NEAR(graded.cost, fine.cost, 5e-3 * fine.cost);
}

TEST_F(MpcEngineTest, ASecondSolveOfTheDiscreteEngineDoesNotAllocate) {
  if (!allocationsAreCounted()) GTEST_SKIP() << "a sanitizer owns malloc";
  TaskSchedule schedule = regularised();
  schedule.ball_position_weight = two(100);
  config_.schedule = std::make_shared<TaskSchedule>(schedule);
  const auto engine = makeEngine(robot_, config_);
  MpcPolicy first = engine->emptyPolicy(), second = first;
  const MpcPolicy seed = lqrSeed(*engine, lqr_);
  const auto before = allocationCount();
  ASSERT_TRUE(engine->solve(kSimStart, x0_, seed, 5, first).ok());
  ASSERT_TRUE(
      engine->solve(simTimeFromNs(14'000'000), first.stateAt(0.014), first, 1, second).ok());
  EXPECT_EQ(allocationCount(), before);
}

TEST_F(MpcEngineTest, EqualInputsGiveEqualBitsWhateverWasSolvedBefore) {
  TaskSchedule schedule = regularised();
  schedule.ball_position_weight = two(100);
  config_.schedule = std::make_shared<TaskSchedule>(schedule);
  for (const auto kind : {MpcConfig::Engine::kDiscrete, MpcConfig::Engine::kContinuous}) {
    config_.engine = kind;
    const auto used = makeEngine(robot_, config_), fresh = makeEngine(robot_, config_);
    MpcPolicy a = used->emptyPolicy(), b = a;
    const MpcPolicy seed = lqrSeed(*used, lqr_);
    MpcState elsewhere = x0_;
    elsewhere[kBallX] += 0.3;
    ASSERT_TRUE(used->solve(simTimeFromNs(5'000'000), elsewhere, seed, 3, a).ok());
    used->setShift(fresh->shift());
    ASSERT_TRUE(used->solve(kSimStart, x0_, seed, 2, a).ok());
    ASSERT_TRUE(fresh->solve(kSimStart, x0_, seed, 2, b).ok());
    for (std::size_t k = 0; k < a.knots().size(); ++k) ASSERT_EQ(a.knots()[k].x, b.knots()[k].x);
    for (std::size_t k = 0; k < a.controls().size(); ++k) {
      ASSERT_EQ(a.controls()[k].u, b.controls()[k].u);
      ASSERT_EQ(a.controls()[k].K, b.controls()[k].K);
    }
  }
}

}  // namespace
}  // namespace ballbot
