#pragma once

#include "model/newton_euler.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// End-effector kinematics from a Newton-Euler pass already made at x; internal to model/.
ReducedDynamics::EndEffector endEffectorOf(const DynamicsConstants& constants,
                                           const NewtonEuler<double>& pass, const StateVector& x);
void linearizeEndEffectorOf(const DynamicsConstants& constants, const NewtonEuler<double>& pass,
                            const StateVector& x, ReducedDynamics::EndEffectorLinearization& out);

}  // namespace ballbot
