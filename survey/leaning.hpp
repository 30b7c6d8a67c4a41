#pragma once

#include <vector>

#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// A robot that leans by the same angle for good: it accelerates.
struct Lean {
  double angle = 0;         ///< beyond rest [rad]
  double acceleration = 0;  ///< of the ball, where the lean points [m/s^2]
  double wheel_torque = 0;  ///< the largest that a wheel gives [N m]
  /// Of wheels that each carry a third of what stands on the ball: tangential by normal force.
  double wheel_friction = 0;
  double floor_friction = 0;  ///< the floor's force on the ball along it, by the robot's weight
};

/// Steady acceleration with the arm held in its pose at `rest`, leaning by `angle` towards
/// `heading` (0: along x of the base, a quarter turn: along y): the torques for which base and arm
/// do not turn, of M dnu/dt + h = S^T tau with dnu/dt = (a, 0, 0).
Lean leanSteadily(const ReducedDynamics& dynamics, const Equilibrium& rest, double angle,
                  double heading);

/// The ball's speed at which the first wheel reaches `wheel_rate` [rad/s], upright and without
/// turning, in the direction in which that is soonest [m/s].
double topSpeed(const RobotParameters& robot, double wheel_rate);

}  // namespace ballbot
