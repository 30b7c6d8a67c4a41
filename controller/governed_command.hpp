#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

namespace ballbot {

/// `v`, no longer than `length`; the same bits where it is no longer.
template <typename Vector>
Vector cutTo(double length, const Vector& v) {
  const double norm = v.norm();
  return norm > length ? Vector(length / norm * v) : v;
}

/// What a plan takes of a command c(t), relative to an anchor a that moves toward it at `speed`. A
/// command within `step` of the anchor is taken as it is, to the last bit: a step the robot can
/// make. One farther away is approached instead, without a jump and at that speed,
///
///   r(t) = a + cut(c(t) - a, lead + speed (t - now)),
///
/// until the anchor is there. Both after c was cut to [lower, upper]. By default nothing is
/// bounded.
template <int N>
struct GovernedCommand {
  using Vector = Eigen::Matrix<double, N, 1>;
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double step = kUnbounded;   ///< [unit of the command]
  double lead = kUnbounded;   ///< of the reference on an approach, less than `step`
  double speed = kUnbounded;  ///< [unit of the command / s]
  Vector lower = Vector::Constant(-kUnbounded), upper = Vector::Constant(kUnbounded);
  Vector anchor = Vector::Zero();
  bool approaching = false;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.anchor);
    visit(self.approaching);
  }

  /// @param asked  the command of a time `ahead` seconds after the plan's start
  Vector reference(const Vector& asked, double ahead) const {
    if (step == kUnbounded) return asked;
    const Vector reachable = withinBox(asked);
    const Vector way = reachable - anchor;
    const double bound = (approaching ? lead : step) + speed * std::max(ahead, 0.0);
    return way.norm() > bound ? Vector(anchor + cutTo(bound, way)) : reachable;
  }
  /// The reference's rate of change, where the command's is `asked_rate`.
  Vector rate(const Vector& asked, const Vector& asked_rate, double ahead) const {
    if (step == kUnbounded) return asked_rate;
    const Vector way = withinBox(asked) - anchor;
    const double bound = (approaching ? lead : step) + speed * std::max(ahead, 0.0);
    return way.norm() > bound ? Vector(speed / way.norm() * way) : cutTo(speed, asked_rate);
  }

  bool cuts(const Vector& asked) const { return reference(asked, 0) != asked; }
  /// Moves the anchor on by `seconds`, and keeps it within `lag` of where the robot is.
  void follow(const Vector& asked, double seconds, const Vector& robot, double lag) {
    const Vector reachable = withinBox(asked);
    anchor += cutTo(speed * seconds, Vector(reachable - anchor));
    const Vector ahead = anchor - robot;
    if (ahead.norm() > lag) anchor = robot + cutTo(lag, ahead);
    const double way = (reachable - anchor).norm();
    approaching = way > (approaching ? lead : step);
  }

 private:
  Vector withinBox(const Vector& v) const { return v.cwiseMax(lower).cwiseMin(upper); }
};

}  // namespace ballbot
