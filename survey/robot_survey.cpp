#include "survey/robot_survey.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr int kPosesOfAJoint = 9;
constexpr int kHeadings = 12;
constexpr double kMostLean = 25 * kRadPerDeg;
constexpr double kShownLeans_deg[] = {1, 2, 5, 10, 15, 20, 25};

// Twice the rate at which it falls; and a torque loop with a damping of 0.7 lags by 81 degrees
// times frequency over bandwidth where that is small.
constexpr double kCrossoverShare = 2;
constexpr double kBandwidthShare = 4;

/// Towards the heading in which a wheel has to give most.
Lean worstLean(const ReducedDynamics& dynamics, const Equilibrium& rest, double angle) {
  Lean worst;
  for (int i = 0; i < kHeadings; ++i) {
    const Lean lean = leanSteadily(dynamics, rest, angle, kTwoPi * i / kHeadings);
    if (lean.wheel_torque > worst.wheel_torque) worst = lean;
  }
  return worst;
}

Lean steepestLean(const ReducedDynamics& dynamics, const Equilibrium& rest, double torque) {
  double holds = 0, fails = kMostLean;
  if (worstLean(dynamics, rest, fails).wheel_torque <= torque)
    return worstLean(dynamics, rest, fails);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (holds + fails);
    (worstLean(dynamics, rest, middle).wheel_torque <= torque ? holds : fails) = middle;
  }
  return worstLean(dynamics, rest, holds);
}

/// From rest to rest: as fast as it can, then brakes, or at top speed in between.
double leastTime(double distance, double acceleration, double speed) {
  if (speed * speed >= distance * acceleration) return 2 * std::sqrt(distance / acceleration);
  return speed / acceleration + distance / speed;
}

void warn(const RobotParameters& robot, RobotSurvey& out) {
  const Workspace& w = out.workspace;
  if (w.unbalanced > 0) {
    out.warnings.push_back(
        fmt::format("{} of {} poses of the arm leave no balance within 30 degrees: keep the arm "
                    "out of them by its limits, or make it lighter",
                    w.unbalanced, w.poses));
  }
  for (int i = 0; i < kArmJointCount; ++i) {
    if (w.largest_arm_torque[i] <= robot.arm_torque_limit) continue;
    out.warnings.push_back(
        fmt::format("joint '{}' needs up to {:.3g} N m to hold still, more than its {:.3g} N m",
                    robot.arm[i].name, w.largest_arm_torque[i], robot.arm_torque_limit));
  }
  if (out.steepest.angle < 2 * kRadPerDeg) {
    out.warnings.push_back(fmt::format(
        "{:.3g} N m at a wheel hold a lean of {:.2g} degrees only: any push is too much",
        robot.wheel_torque_limit, out.steepest.angle * kDegPerRad));
  }
}

}  // namespace

RobotSurvey surveyRobot(const RobotParameters& robot) {
  const ReducedDynamics dynamics(robot);
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  RobotSurvey out;
  out.mass = robot.totalMass();
  out.mass_on_ball = out.mass - robot.ball.mass;
  // Energy against height: dV = m g dz, whatever is where.
  const double potential = dynamics.potentialEnergy(rest.x.head<kPositionDim>());
  out.height = (potential / robot.gravity - out.mass * robot.ball.radius) / out.mass_on_ball;
  out.pitch = rest.x[kPitch];
  out.roll = rest.x[kRoll];
  out.arm_torque = rest.tau.tail<kArmJointCount>();
  out.fall_rate = fallRate(dynamics, rest);

  out.workspace = surveyWorkspace(dynamics, kPosesOfAJoint);
  for (const double angle_deg : kShownLeans_deg) {
    out.leans.push_back(worstLean(dynamics, rest, angle_deg * kRadPerDeg));
  }
  out.steepest = steepestLean(dynamics, rest, robot.wheel_torque_limit);
  const double brake = out.steepest.acceleration;
  out.top_speed =
      robot.wheel_speed_limit < kUnlimited ? topSpeed(robot, robot.wheel_speed_limit) : kUnlimited;
  out.braking_distance =
      out.top_speed < kUnlimited ? out.top_speed * out.top_speed / (2 * brake) : kUnlimited;
  out.metre_s = leastTime(1, brake, out.top_speed);
  out.least_crossover = kCrossoverShare * out.fall_rate;
  out.least_bandwidth_Hz = kBandwidthShare * out.least_crossover / kTwoPi;
  warn(robot, out);
  return out;
}

}  // namespace ballbot
