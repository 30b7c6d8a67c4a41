#pragma once

#include "core/time.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

/// What the ball's friction gives each wheel, whether it rolls or slips: what is at its spring,
/// less what speeds it up, smoothed over kWindow. Without a derivative of anything measured, and
/// without the base's own acceleration, which is little beside a wheel's. Free of allocation; for
/// the control step.
class WheelGrip {
 public:
  explicit WheelGrip(const RobotParameters& robot) : inertia_(robot.wheels.spin_inertia) {}

  /// One frame of the sensors. @param torque  at the springs [N m], @param velocity  [rad/s]
  void update(SimTime now, const Vector3& torque, const Vector3& velocity) noexcept;

  /// On each wheel's own axle, against its torque [N m].
  Vector3 torque() const noexcept { return torque_ - inertia_ / kWindow * (latest_ - velocity_); }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.last_);
    visit(self.torque_);
    visit(self.velocity_);
    visit(self.latest_);
  }

  static constexpr double kWindow = 0.01;  ///< [s]

 private:
  double inertia_;  ///< of a wheel about its axle [kg m^2]
  SimTime last_{};
  Vector3 torque_ = Vector3::Zero(), velocity_ = Vector3::Zero();  ///< smoothed
  Vector3 latest_ = Vector3::Zero();                               ///< velocity
};

}  // namespace ballbot
