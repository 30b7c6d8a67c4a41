#pragma once

#include "plant/face_contact.hpp"

namespace ballbot {

class ConfigVisitor;

/// A leaf on a vertical hinge. Angle zero is closed; it opens to the side away from its front, and
/// the front passes through the axis of the hinge. Torque about the hinge, positive to open:
///
///   I a = tau_contact - damping w - friction tanh(w / smoothing) - closer - stops,
///   closer = torque + stiffness angle; stops: spring and damper beyond closed and fully open.
struct DoorParameters {
  Eigen::Vector2d hinge = Eigen::Vector2d::Zero();  ///< in W [m]
  double closed_heading = 0;     ///< of the closed leaf, seen from the hinge, about z_W [rad]
  bool counterclockwise = true;  ///< seen from above, as it opens
  double width = 0.9, height = 2, thickness = 0.04;  ///< of the leaf [m]
  double inertia = 6;                                ///< about the hinge [kg m^2]
  double damping = 0;                                ///< [N m s/rad]
  double friction = 0;                               ///< [N m]
  double friction_smoothing = 0.01;  ///< rate at which three quarters of it are reached [rad/s]
  double closer_torque = 0;          ///< towards closed, at closed [N m]
  double closer_stiffness = 0;       ///< [N m/rad]
  double opening_limit = 2;          ///< [rad]
  double stop_stiffness = 4000;      ///< of frame and buffer [N m/rad]
  double stop_damping = 60;          ///< [N m s/rad]

  void describe(ConfigVisitor& v);
};

/// Angle and rate of a door.
struct DoorMotion {
  double angle = 0, rate = 0;  ///< [rad, rad/s]
};

/// At rest in the frame, where the closer holds it.
DoorMotion doorAtRest(const DoorParameters& p);
/// The front of the leaf.
Face doorFace(const DoorParameters& p, const DoorMotion& m);
/// Torque about the hinge of a force on the leaf, positive to open [N m].
double openingTorque(const DoorParameters& p, const Vector3& point_W, const Vector3& force_W);
/// Angular acceleration under a torque [rad/s^2].
double doorAcceleration(const DoorParameters& p, const DoorMotion& m, double torque);
/// Kinetic energy, closer and stops [J].
double doorEnergy(const DoorParameters& p, const DoorMotion& m);

}  // namespace ballbot
