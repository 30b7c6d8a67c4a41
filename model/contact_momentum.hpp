#pragma once

#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// The whole robot, ball included, about the point P where the ball touches the floor. No torque of
/// a drive, friction in a drive or force of the floor at P appears in
///
///   dH/dt = first moment x gravity - v_K x m v_C + moment of what pushes from outside
///
/// about horizontal axes: what a robot without a push does not do is fall or rise by itself. H is
/// N(q)^T M(q) nu with the two motions N that turn robot and ball about P like one rigid body, S(q)
/// N = 0.
///
/// @return H about the axes x and y of W through P [kg m^2/s]
/// @param x  whole-body state (q, nu). Free of allocation, as all of this.
Eigen::Vector2d contactMomentum(const ReducedDynamics& dynamics, const StateVector& x);

/// What gravity does to H.
struct GravityAboutContact {
  Eigen::Vector2d moment_W;  ///< first moment x gravity, about x and y of W [N m]
  double height_moment;      ///< mass times height of the centre of mass [kg m]
};
GravityAboutContact gravityAboutContact(const ReducedDynamics& dynamics, const PositionVector& q);

}  // namespace ballbot
