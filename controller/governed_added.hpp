#pragma once

#include "controller/governed_orientation.hpp"

namespace ballbot {

/// Of which kind the command of an added task is, and so how it is governed.
enum class CommandKind {
  kFree,         ///< taken as it is: nobody knows what the robot can be asked for
  kPlace,        ///< a point in W [m]
  kOrientation,  ///< yaw, pitch, roll of a frame in W [rad]
};

/// GovernedCommand for the command of an added task.
struct GovernedAdded {
  CommandKind kind = CommandKind::kFree;
  GovernedCommand<3> place;
  GovernedOrientation orientation;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    if (self.kind == CommandKind::kPlace) visit(self.place);
    if (self.kind == CommandKind::kOrientation) visit(self.orientation);
  }

  Vector3 reference(const Vector3& asked, double ahead) const noexcept;
  bool cuts(const Vector3& asked) const noexcept;
  /// The anchor where the command is at first.
  void start(const Vector3& asked) noexcept;
  /// @param robot  where the robot is, in the command's terms
  /// @param lag, angle_lag  of the anchor from there [m], [rad]
  void follow(const Vector3& asked, double seconds, const Vector3& robot, double lag,
              double angle_lag) noexcept;
};

}  // namespace ballbot
