#include "controller/lost_wheels.hpp"

#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "controller/mpc_planner.hpp"
#include "tests/controller/support/lqr_seed.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

SimTime at(double ms) { return simTimeFromNs(static_cast<std::int64_t>(ms * 1e6)); }

TEST(LostWheels, AreThoseRefusedWithoutABreak) {
  LostWheels wheels{WheelLoss{}};
  const WheelFlags second{false, true, false}, none{};
  EXPECT_FALSE(wheels.update(at(0), second));
  EXPECT_FALSE(wheels.update(at(7.5), second));
  EXPECT_FALSE(wheels.update(at(8), none)) << "a spike";
  EXPECT_FALSE(wheels.update(at(10), second));
  EXPECT_FALSE(wheels.update(at(27.5), second));
  EXPECT_TRUE(wheels.update(at(30), second));
  EXPECT_EQ(wheels.lost(), second);
  EXPECT_FALSE(wheels.update(at(100), none));
  EXPECT_FALSE(wheels.update(at(190), second)) << "not believed for long enough";
  EXPECT_FALSE(wheels.update(at(192.5), none));
  EXPECT_FALSE(wheels.update(at(290), none));
  EXPECT_TRUE(wheels.update(at(292.5), none));
  EXPECT_FALSE(wheels.any());
  EXPECT_EQ(wheels.losses(), 1);
}

TEST(LostWheels, AreBelievedLaterEachTimeThatTheySlipAgain) {
  LostWheels wheels{WheelLoss{}};
  const WheelFlags first{true, false, false}, none{};
  double ms = 0;
  const auto untilTrusted = [&] {
    for (const double begin = ms; ms < begin + 30; ms += 2.5) wheels.update(at(ms), first);
    EXPECT_TRUE(wheels.any());
    const double begin = ms;
    for (; wheels.any(); ms += 2.5) wheels.update(at(ms), none);
    return ms - 2.5 - begin;
  };
  for (const double expected : {100, 200, 400, 800, 1600, 1600})
    EXPECT_EQ(untilTrusted(), expected);
  for (const double begin = ms; ms < begin + 1100; ms += 2.5) wheels.update(at(ms), none);
  EXPECT_EQ(untilTrusted(), 100) << "long ago";
}

TEST(LostWheels, SeveralAtOnceAreAStateThatFitsNothing) {
  LostWheels wheels{WheelLoss{}};
  for (double ms = 0; ms < 100; ms += 2.5) {
    EXPECT_FALSE(wheels.update(at(ms), {true, true, false}));
  }
  EXPECT_TRUE(wheels.update(at(100), {true, false, false})) << "the one that is left";
  EXPECT_EQ(wheels.lost(), (WheelFlags{true, false, false}));
  EXPECT_TRUE(wheels.update(at(200), {true, true, false})) << "and it was not the wheel";
  EXPECT_FALSE(wheels.any());
}

TEST(LostWheels, ADeadDriveIsLostAsLongAsItIsDead) {
  LostWheels wheels{WheelLoss{}};
  const WheelFlags third{false, false, true}, none{};
  EXPECT_TRUE(wheels.update(at(0), {true, false, false}, third));
  EXPECT_EQ(wheels.lost(), third);
  for (double ms = 2.5; ms < 1000; ms += 2.5) EXPECT_FALSE(wheels.update(at(ms), none, third));
  EXPECT_TRUE(wheels.update(at(1000), none, none));
  EXPECT_FALSE(wheels.any());
  EXPECT_EQ(wheels.losses(), 1);
}

TEST(LostWheels, AreKeptWhereAsked) {
  WheelLoss settings;
  settings.counted_out = false;
  LostWheels wheels(settings);
  for (double ms = 0; ms < 100; ms += 2.5) wheels.update(at(ms), {true, false, false});
  EXPECT_FALSE(wheels.any());
}

// The model's own derivatives, without yaw and its rate: what is left is brought to rest.
TEST(LqrWithoutAWheel, BalancesWithTheOtherTwoAndLeavesYawAlone) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  for (int wheel = 0; wheel < kWheelCount; ++wheel) {
    WheelFlags lost{};
    lost[static_cast<std::size_t>(wheel)] = true;
    const LqrSolution lqr = designLqr(dynamics, robot.nominal_arm, LqrWeights{}, lost);
    EXPECT_EQ(lqr.K.row(wheel).norm(), 0);
    ReducedDynamics::Linearization model;
    dynamics.linearize(lqr.equilibrium.x, lqr.equilibrium.tau, Vector3::Zero(), model);
    std::vector<int> kept;
    for (int i = 0; i < kStateDim; ++i) {
      if (i == kYaw || i == kPositionDim + kOmegaZ) {
        EXPECT_LT(lqr.K.col(i).norm(), 1e-9);
      } else {
        kept.push_back(i);
      }
    }
    const StateJacobian closed = model.df_dx + model.df_dtau * lqr.K;
    const Eigen::MatrixXd rest = closed(kept, kept);
    EXPECT_LT(rest.eigenvalues().real().maxCoeff(), -0.3);
  }
}

class PlanWithoutAWheel : public testing::Test {
 protected:
  PlanWithoutAWheel() : config_(robot_) {
    config_.horizon.length = 0.6;
    config_.shaping = {40, 200};
    auto tasks = std::make_shared<TaskSchedule>(robot_);
    tasks->ball_position_weight = TimedWeight<2>(Eigen::Vector2d::Constant(100));
    tasks->ball_velocity_weight = TimedWeight<2>(Eigen::Vector2d::Constant(10));
    tasks->base_rate_weight = TimedWeight<3>(Vector3::Constant(4));
    tasks->arm_rate_weight = TimedWeight<3>(Vector3::Constant(0.5));
    tasks->wheel_torque_weight = TimedWeight<1>(Eigen::Matrix<double, 1, 1>(2));
    tasks->arm_torque_weight = TimedWeight<1>(Eigen::Matrix<double, 1, 1>(0.1));
    config_.schedule = tasks;
    x0_ << lqr_.equilibrium.x, Vector3(0.5, -0.3, 0.2);
    x0_[kBallX] = 0.05;
    x0_[kPitch] += 0.04;
    x0_[kPositionDim + kOmegaX] = 0.2;
  }
  MpcSolveReport solve(MpcEngine& engine, int iterations, MpcPolicy& out) const {
    return engine.solve(kSimStart, x0_, lqrSeed(engine, lqr_), iterations, out);
  }

  RobotParameters robot_ = exampleRobot();
  LqrSolution lqr_ = designLqr(ReducedDynamics(robot_), robot_.nominal_arm, LqrWeights{});
  MpcConfig config_;
  MpcState x0_;
};

constexpr WheelFlags kSecond{false, true, false};

PlanConditions conditions(double floor_held, const WheelFlags& lost) {
  PlanConditions out;
  out.floor_held = floor_held;
  out.lost_wheels = lost;
  return out;
}

TEST_F(PlanWithoutAWheel, AsksNothingOfItAndMovesAsTheRobotWouldWithoutIt) {
  config_.horizon.coarse_step = 0.0025;
  const auto engine = makeEngine(robot_, config_);
  engine->setConditions(conditions(kUnlimited, kSecond));
  MpcPolicy plan = engine->emptyPolicy();
  ASSERT_EQ(solve(*engine, 60, plan).status, SlqStatus::kConverged);
  double others = 0;
  for (const auto& control : plan.controls()) {
    EXPECT_NEAR(control.u[1], 0, 1e-9);
    EXPECT_EQ(control.K.row(1).norm(), 0);
    others = std::max(others, std::abs(control.u[0]));
  }
  EXPECT_GT(others, 0.3);

  // The planned torques on the model, in small steps.
  const ReducedDynamics dynamics(robot_);
  StateVector x = x0_.head<kStateDim>();
  constexpr int kSteps = 20;
  for (const auto& control : plan.controls()) {
    JointVector tau = control.u.head<kJointCount>();
    tau[1] = 0;
    const double h = config_.horizon.coarse_step / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const StateVector slope = dynamics.derivative(x, tau, Vector3::Zero());
      x += h * dynamics.derivative(x + 0.5 * h * slope, tau, Vector3::Zero());
    }
  }
  const StateVector planned = plan.knots().back().x.head<kStateDim>();
  EXPECT_LT((x - planned).cwiseAbs().maxCoeff(), 0.015);
}

TEST_F(PlanWithoutAWheel, IsTheSameInBothEngines) {
  MpcSolveReport report[2];
  for (const auto kind : {MpcConfig::Engine::kDiscrete, MpcConfig::Engine::kContinuous}) {
    config_.engine = kind;
    const bool continuous = kind == MpcConfig::Engine::kContinuous;
    config_.horizon.coarse_step = continuous ? 0.01 : 0.0025;
    const auto engine = makeEngine(robot_, config_);
    engine->setConditions(conditions(kUnlimited, kSecond));
    MpcPolicy plan = engine->emptyPolicy();
    report[continuous ? 1 : 0] = solve(*engine, 60, plan);
    ASSERT_TRUE(report[continuous ? 1 : 0].ok());
  }
  EXPECT_NEAR(report[0].cost, report[1].cost, 2e-3 * report[1].cost);
}

TEST_F(PlanWithoutAWheel, LeavesNothingBehind) {
  for (const auto kind : {MpcConfig::Engine::kDiscrete, MpcConfig::Engine::kContinuous}) {
    for (const double held : {0.4, kUnlimited}) {
      config_.engine = kind;
      const auto used = makeEngine(robot_, config_), fresh = makeEngine(robot_, config_);
      MpcPolicy a = used->emptyPolicy(), b = a;
      used->setConditions(conditions(0.4, {}));
      ASSERT_TRUE(solve(*used, 2, a).ok());
      used->setConditions(conditions(0.4, kSecond));
      ASSERT_TRUE(solve(*used, 2, a).ok());
      used->setShift(fresh->shift());
      for (MpcEngine* engine : {used.get(), fresh.get()})
        engine->setConditions(conditions(held, {}));

      ASSERT_TRUE(solve(*used, 2, a).ok());
      ASSERT_TRUE(solve(*fresh, 2, b).ok());
      for (std::size_t k = 0; k < a.controls().size(); ++k) {
        ASSERT_EQ(a.controls()[k].u, b.controls()[k].u);
        ASSERT_EQ(a.controls()[k].K, b.controls()[k].K);
      }
    }
  }
}

}  // namespace
}  // namespace ballbot
