#include "survey/workspace.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "model/limits.hpp"

namespace ballbot {
namespace {

constexpr double kMostPoses = 5000;

/// From limit to limit, or once around.
double angleAt(const ArmLink& link, int i, int steps) {
  const bool around = link.lower_limit <= -kUnlimited || link.upper_limit >= kUnlimited;
  const double lower = around ? -kPi : link.lower_limit, upper = around ? kPi : link.upper_limit;
  return steps > 1 ? lower + (upper - lower) * i / (steps - 1) : 0.5 * (lower + upper);
}

void widen(double value, bool first, double& least, double& largest) {
  least = first ? value : std::min(least, value);
  largest = first ? value : std::max(largest, value);
}

}  // namespace

double fallRate(const ReducedDynamics& dynamics, const Equilibrium& rest) {
  ReducedDynamics::Linearization at_rest;
  dynamics.linearize(rest.x, rest.tau, Vector3::Zero(), at_rest);
  // The arm is held: what falls is the robot as it stands.
  Eigen::Matrix<double, kStateDim, kStateDim> A = at_rest.df_dx;
  const Eigen::Matrix<double, kVelocityDim, kArmJointCount> by_torque =
      at_rest.df_dtau.bottomRightCorner<kVelocityDim, kArmJointCount>();
  const Eigen::Matrix<double, kArmJointCount, kArmJointCount> to_hold =
      by_torque.bottomRows<kArmJointCount>().inverse();
  A.bottomRows<kVelocityDim>() -= by_torque * to_hold * at_rest.df_dx.bottomRows<kArmJointCount>();
  return A.eigenvalues().real().maxCoeff();
}

Workspace surveyWorkspace(const ReducedDynamics& dynamics, int steps) {
  const RobotParameters& robot = dynamics.robot();
  Workspace out;
  while (steps > 2 && std::pow(steps, kArmJointCount) > kMostPoses) --steps;
  const int poses = static_cast<int>(std::lround(std::pow(steps, kArmJointCount)));
  for (int pose = 0; pose < poses; ++pose) {
    ArmVector arm;
    for (int j = 0, rest = pose; j < kArmJointCount; ++j, rest /= steps) {
      arm[j] = angleAt(robot.arm[j], rest % steps, steps);
    }
    ++out.poses;
    Equilibrium rest;
    try {
      rest = findEquilibrium(dynamics, arm);
    } catch (const NumericalError&) {
      ++out.unbalanced;
      continue;
    }
    const bool first = out.poses - out.unbalanced == 1;
    const double tilt = std::acos(std::cos(rest.x[kPitch]) * std::cos(rest.x[kRoll]));
    if (first || tilt > out.largest_tilt) {
      out.largest_tilt = tilt;
      out.most_tilted_arm = arm;
    }
    widen(fallRate(dynamics, rest), first, out.least_fall_rate, out.largest_fall_rate);
    out.largest_arm_torque =
        out.largest_arm_torque.cwiseMax(rest.tau.tail<kArmJointCount>().cwiseAbs());
    const Vector3 p = dynamics.endEffector(rest.x).p_WE;
    widen(p.head<2>().norm(), first, out.least_reach, out.largest_reach);
    widen(p.z(), first, out.least_height, out.largest_height);
  }
  return out;
}

}  // namespace ballbot
