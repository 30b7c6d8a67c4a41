#pragma once

#include <vector>

#include "model/state.hpp"

namespace ballbot {

class ConfigVisitor;

/// A disc of the floor on which it holds a spin with another torque.
struct FloorPatch {
  Eigen::Vector2d center_W = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0;                                   ///< [m]
  double torque = 0;                                   ///< [N m]

  void describe(ConfigVisitor& v);
};

/// Friction torque of the floor on the ball's spin s about the vertical: -torque tanh(s /
/// smoothing). With compliant contact it goes with the load; this is then that of the robot at
/// rest. A patch of radius a that carries N with friction mu holds (3 pi/16) mu N a (Hertz).
struct SpinFriction {
  double torque = 0.8;              ///< [N m]
  double smoothing = 0.02;          ///< spin at which three quarters of it are reached [rad/s]
  std::vector<FloorPatch> patches;  ///< where they overlap, the last one counts

  /// What the floor holds under a ball there [N m].
  double heldAt(const Eigen::Vector2d& p_WK) const noexcept;

  void describe(ConfigVisitor& v);
};

/// Floor and ball about the vertical, as they truly are.
struct BallOnFloor {
  double spin_rate = 0;  ///< of the ball [rad/s]
  double torque = 0;     ///< of the floor on it [N m]
  double held = 0;       ///< the largest that this can be [N m]
};

}  // namespace ballbot
