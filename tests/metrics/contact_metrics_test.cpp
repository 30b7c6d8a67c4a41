#include "metrics/contact_metrics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "model/body_poses.hpp"
#include "model/reduced_dynamics.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

TEST(StaticBalance, CentreOfMassIsWhereTheModelsGravityHasIt) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  for (int i = 0; i < 10; ++i) {
    StateVector x = randomCase(i).x;
    x.tail<kVelocityDim>().setZero();
    // At rest: energy = m_K g r + m_u g z.
    const UpperBody body = upperBody(robot, x);
    EXPECT_NEAR(dynamics.energy(x),
                robot.gravity * (robot.ball.mass * robot.ball.radius + body.mass * body.p_WC.z()),
                1e-9);
    EXPECT_NEAR(body.mass, robot.totalMass() - robot.ball.mass, 1e-12);
    const auto poses = bodyPoses(robot, x);
    EXPECT_LT(
        (poses.back().p_WL + poses.back().R_WL * robot.p_A3E - dynamics.endEffector(x).p_WE).norm(),
        1e-12);
  }
}

/// Leans against a force and stands still: found with the dynamics, not with the statics under
/// test.
StateVector atRestUnder(const ReducedDynamics& dynamics, const Vector3& force_W) {
  const Vector3 arm = dynamics.robot().nominal_arm;
  StateVector x = StateVector::Zero();
  x.segment<3>(kArm1) = arm;
  // Newton on the pitch: with torques free, the ball and the base stay at rest only if the moment
  // about the floor contact vanishes, i.e. M-weighted acceleration is in the range of S^T.
  const auto unbalanced = [&](double pitch) {
    x[kPitch] = pitch;
    const PositionVector q = x.head<kPositionDim>();
    const VelocityVector need = dynamics.nonlinearEffects(q, VelocityVector::Zero()) -
                                dynamics.endEffectorJacobian(q).topRows<3>().transpose() * force_W;
    const SelectionMatrix S = dynamics.selectionMatrix(q);
    const JointVector tau = S.transpose().colPivHouseholderQr().solve(need);
    const VelocityVector left = need - S.transpose() * tau;
    return left[kBallVx] + left[kOmegaY];
  };
  double low = -0.3, high = 0.3;
  EXPECT_LT(unbalanced(low) * unbalanced(high), 0);
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (unbalanced(low) * unbalanced(middle) <= 0 ? high : low) = middle;
  }
  return x;
}

TEST(StaticBalance, HoldsForARobotThatStandsStillUnderAForce) {
  const RobotParameters robot = exampleRobot();
  const ReducedDynamics dynamics(robot);
  for (const Vector3& force :
       {Vector3(0, 0, 0), Vector3(-5, 0, 0), Vector3(-10, 0, -3), Vector3(-3, 0, 4)}) {
    TruthFrame truth;
    truth.state = atRestUnder(dynamics, force);
    truth.p_WE = dynamics.endEffector(truth.state).p_WE;
    truth.contact_force_W = force;
    const Lean lean = leanOf(robot, truth, Vector3::UnitX());
    EXPECT_NEAR(lean.shift, lean.balanced_shift, 1e-9) << force.transpose();
    if (force.z() == 0) {
      EXPECT_NEAR(lean.shift, lean.normal_shift, 1e-9);
    }
  }
}

/// Pushes along x with a force that builds up over a second and then wavers by `ripple`.
std::map<std::string, double> pushed(double asked, double given, double ripple) {
  const RobotParameters robot = exampleRobot();
  ContactMetrics metrics(robot);
  TruthFrame truth;
  truth.state.segment<3>(kArm1) = robot.nominal_arm;
  truth.p_WE << 0.2, 0, 0.95;
  for (double t = 0; t < 10; t += 1e-3) {
    truth.time = at(t);
    const bool touching = t >= 1.2;
    const double ramp = std::min(1.0, std::max(0.0, t - 1));
    const double force =
        touching ? ramp * given + (t > 2 ? ripple * std::sin(20 * M_PI * t) : 0) : 0;
    truth.contact_force_W << -force, 0, 0;
    truth.contact_phase = touching ? ContactPhase::kSticking : ContactPhase::kNone;
    truth.door_angle = touching ? 0.05 * (t - 1.2) : 0;
    metrics.add(truth, Vector3(-asked * ramp, 0, 0), truth.contact_force_W + Vector3(0, 0.3, 0));
  }
  return metrics.values();
}

TEST(ContactMetrics, JudgesTheSteadyForceByMeanAndDeviation) {
  const auto m = pushed(5, 4.5, 0.4);
  EXPECT_NEAR(m.at("force_mean_N"), 4.5, 1e-3);
  EXPECT_NEAR(m.at("force_mean_error_percent"), 10, 0.05);
  EXPECT_NEAR(m.at("force_rms_error_steady_N"), std::sqrt(0.25 + 0.08), 1e-3);
  EXPECT_NEAR(m.at("force_rms_error_percent"), 100 * std::sqrt(0.33) / 5, 0.05);
  EXPECT_NEAR(m.at("force_sensing_rms_error_N"), 0.3, 1e-9);
  EXPECT_EQ(m.at("contact_phases"), 1);
  EXPECT_NEAR(m.at("contact_kept_percent"), 100, 0.05);
  EXPECT_NEAR(m.at("contact_time_s"), 8.8, 2e-3);
  EXPECT_NEAR(m.at("final_door_angle_deg"), 57.29578 * 0.05 * 8.8, 0.01);
  EXPECT_EQ(m.at("contact_sliding_percent"), 0);
}

TEST(ContactMetrics, AContactThatBreaksIsNotKept) {
  ContactMetrics metrics(exampleRobot());
  TruthFrame truth;
  truth.p_WE << 0.2, 0, 0.95;
  for (double t = 0; t < 10; t += 1e-2) {
    truth.time = at(t);
    const bool touching = t > 1 && (t < 5 || t > 7);
    truth.contact_phase = touching ? ContactPhase::kSliding : ContactPhase::kNone;
    truth.contact_force_W << (touching ? -5 : 0), 0, 0;
    metrics.add(truth, {-5, 0, 0}, Vector3::Zero());
  }
  const auto m = metrics.values();
  EXPECT_EQ(m.at("contact_phases"), 2);
  EXPECT_NEAR(m.at("contact_kept_percent"), 100 * 7.0 / 9, 0.3);
  EXPECT_EQ(m.at("contact_sliding_percent"), 100);
}

TEST(ContactMetrics, HowADoorIsOpenedIsJudgedUntilItStandsAtItsStop) {
  ContactMetrics metrics(exampleRobot(), 1.0);
  TruthFrame truth;
  truth.p_WE << 0.2, 0, 0.95;
  for (double t = 0; t < 10; t += 1e-2) {
    truth.time = at(t);
    truth.door_angle = std::min(1.01, 0.2 * t);  // there at 5 s: the hand slips off at 6 s
    const bool touching = t < 6;
    truth.contact_phase = touching ? ContactPhase::kSticking : ContactPhase::kNone;
    truth.contact_force_W << (t < 5 ? -5 : touching ? -9 : 0), 0, 0;
    metrics.add(truth, {-5, 0, 0}, Vector3::Zero());
  }
  const auto m = metrics.values();
  EXPECT_EQ(m.at("contact_kept_percent"), 100);
  EXPECT_NEAR(m.at("force_mean_N"), 5, 1e-9);
  EXPECT_EQ(m.at("largest_contact_force_N"), 9);
  EXPECT_NEAR(m.at("final_door_angle_deg"), 1.01 * 180 / M_PI, 1e-9);
}

TEST(ContactMetrics, SayNothingOfARunWithoutContact) {
  ContactMetrics metrics(exampleRobot());
  TruthFrame truth;
  for (double t = 0; t < 1; t += 1e-2) {
    truth.time = at(t);
    metrics.add(truth, Vector3::Zero(), Vector3::Zero());
  }
  EXPECT_TRUE(metrics.values().empty());
}

TEST(ContactMetrics, EveryNameItGivesIsKnown) {
  const auto names = ContactMetrics::names();
  for (const auto& [name, value] : pushed(5, 5, 0)) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    EXPECT_TRUE(std::isfinite(value)) << name;
  }
}

}  // namespace
}  // namespace ballbot
