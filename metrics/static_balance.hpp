#pragma once

#include "model/robot_parameters.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Everything above the ball as one mass: base with wheels, arm, payload.
struct UpperBody {
  double mass = 0;                 ///< [kg]
  Vector3 p_WC = Vector3::Zero();  ///< centre of mass [m]
};
UpperBody upperBody(const RobotParameters& robot, const StateVector& x);

/// How far the upper body's centre of mass stands before the ball's centre, along the horizontal
/// direction in which the robot pushes, and how far a robot at rest must have it there so that the
/// moments about the ball's contact with the floor are in balance:
///
///   m_u g s = F z_E + F_z e,
///
/// F: the environment's force on E against the direction of pushing, F_z its upward part, z_E
/// height of E, e distance of E before the ball.
struct Lean {
  double shift = 0;           ///< of the centre of mass [m]
  double normal_shift = 0;    ///< balances F alone, F_z left out [m]
  double balanced_shift = 0;  ///< balances both [m]
  double angle = 0;  ///< of the base's z axis from vertical, in the direction of pushing [rad]
};
/// @param push  unit vector, horizontal: where the robot pushes to
Lean leanOf(const RobotParameters& robot, const TruthFrame& truth, const Vector3& push);

}  // namespace ballbot
