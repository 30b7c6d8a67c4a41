#pragma once

#include <optional>

#include "plant/door.hpp"

namespace ballbot {

class ConfigNode;
class ConfigVisitor;

/// A wall that stands still.
struct WallParameters {
  Vector3 p_WF = Vector3::Zero();  ///< middle of its foot [m]
  double heading = 0;              ///< where its front looks, about z_W [rad]
  double width = 2, height = 2;    ///< [m]

  void describe(ConfigVisitor& v);
};
Face wallFace(const WallParameters& p);

/// What stands around the robot and can be touched by the end-effector.
struct SurroundingsParameters {
  ContactParameters contact;
  std::optional<WallParameters> wall;
  std::optional<DoorParameters> door;

  /// Keys contact, wall and door of the `environment:` section; all optional.
  void describe(ConfigVisitor& v);
};

/// Wall and door as part of an ordinary differential equation:
///
///   s = (door angle, door rate, stretch of the contact with the door (2)
///        | stretch of the contact with the wall (2)),   each if it is there.
///
/// The end-effector is a point that touches either of them, or both in a corner.
class Surroundings {
 public:
  explicit Surroundings(const SurroundingsParameters& p) : p_(p) {}

  int stateDim() const { return (p_.door ? 4 : 0) + (p_.wall ? 2 : 0); }
  /// Door at rest, nothing touched.
  void place(double* s) const;

  /// A point and its velocity in W [m, m/s].
  struct Point {
    Vector3 p_W = Vector3::Zero(), v_W = Vector3::Zero();
  };
  /// Force on the end-effector [N], and ds/dt.
  Vector3 derivative(const double* s, const Point& end_effector, double* sdot) const;
  /// After a step: tangential springs back to what friction holds, to nothing without contact.
  void settle(const Point& end_effector, double* s) const;

  /// For the record: the sum of forces, and phase and foot of the contact; without contact the
  /// foot is the end-effector itself.
  Touch observe(const double* s, const Point& end_effector) const;
  /// The door's motion; zero if there is no door.
  DoorMotion door(const double* s) const;
  /// Of the door and of all springs [J].
  double energy(const double* s, const Point& end_effector) const;

 private:
  Touch touchDoor(const double* s, const Point& e) const;
  Touch touchWall(const double* s, const Point& e) const;
  int wallState() const { return p_.door ? 4 : 0; }

  SurroundingsParameters p_;
};

}  // namespace ballbot
