#pragma once

#include "controller/governed_command.hpp"
#include "model/frames.hpp"

namespace ballbot {

/// GovernedCommand for an orientation: the way from the anchor to the command is the shortest turn,
/// about one axis of W. What is more than half a turn away is nearer the other way round; turns
/// that are to be made are asked for by a reference that turns.
struct GovernedOrientation {
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double step = kUnbounded;   ///< [rad]
  double lead = kUnbounded;   ///< of the reference on an approach, less than `step` [rad]
  double speed = kUnbounded;  ///< [rad/s]
  Matrix3 anchor = Matrix3::Identity();
  bool approaching = false;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.anchor);
    visit(self.approaching);
  }

  /// @param R_asked  the command of a time `ahead` seconds after the plan's start
  Matrix3 reference(const Matrix3& R_asked, double ahead) const {
    if (step == kUnbounded) return R_asked;
    const Vector3 way = turnTo(R_asked);
    const double bound = (approaching ? lead : step) + speed * std::max(ahead, 0.0);
    return way.norm() > bound ? Matrix3(expSO3(cutTo(bound, way)) * anchor) : R_asked;
  }
  /// The reference's angular velocity in W, where the command's is `w_asked_W` [rad/s].
  Vector3 rate(const Matrix3& R_asked, const Vector3& w_asked_W, double ahead) const {
    if (step == kUnbounded) return w_asked_W;
    const Vector3 way = turnTo(R_asked);
    const double bound = (approaching ? lead : step) + speed * std::max(ahead, 0.0);
    return way.norm() > bound ? Vector3(speed / way.norm() * way) : cutTo(speed, w_asked_W);
  }

  bool cuts(const Matrix3& R_asked) const { return reference(R_asked, 0) != R_asked; }
  /// Moves the anchor on by `seconds`, and keeps it within `lag` of the robot's orientation.
  void follow(const Matrix3& R_asked, double seconds, const Matrix3& R_robot, double lag) {
    const Vector3 way = turnTo(R_asked);
    anchor = way.norm() > speed * seconds ? Matrix3(expSO3(cutTo(speed * seconds, way)) * anchor)
                                          : R_asked;
    const Vector3 ahead = logSO3(anchor * R_robot.transpose());
    if (ahead.norm() > lag) anchor = expSO3(cutTo(lag, ahead)) * R_robot;
    approaching = turnTo(R_asked).norm() > (approaching ? lead : step);
  }

 private:
  Vector3 turnTo(const Matrix3& R) const { return logSO3(R * anchor.transpose()); }
};

}  // namespace ballbot
