#pragma once

#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// A lasting force as a plan takes it: where the robot stands still under it, and what it does to
/// the motion near there.
struct LastingLoad {
  bool acts = false;
  StateVector x = StateVector::Zero();       ///< at rest, leaned so that it stays
  JointVector torque = JointVector::Zero();  ///< that holds it there [N m]
  JointVector shift = JointVector::Zero();   ///< of the torque, by the force, in the same pose but
                                             ///< for the lean [N m]
  VelocityVector acceleration = VelocityVector::Zero();  ///< by the force, taken as constant
};

/// The robot at rest under generalised forces d (N, N m; rows of nu):
///
///   S(q)^T tau + d = h(q, 0).
///
/// The two motions that no drive can make, robot and ball turning about the contact like one rigid
/// body, give pitch and roll by Newton's method; the wheels' torques follow from the base's rows,
/// the arm's from its own. Free of allocation; for the control step.
///
/// @param at  gives the ball's place, the yaw and the arm's angles; pitch and roll begin there
/// @return false if there is no such rest within 20 degrees
bool findLastingLoad(const ReducedDynamics& dynamics, const StateVector& at,
                     const VelocityVector& force, LastingLoad& out) noexcept;

}  // namespace ballbot
