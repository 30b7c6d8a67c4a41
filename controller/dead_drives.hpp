#pragma once

#include <array>

#include "core/time.hpp"
#include "model/robot_parameters.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

class ConfigVisitor;

/// When a wheel's drive counts as dead.
struct DriveLoss {
  bool found = true;
  /// Less than this share of what should arrive does, while of the others more than 0.7 does ...
  double share = 0.2;
  /// ... where it should be more than this [N m] ...
  double least_torque_Nm = 0.5;
  /// ... for so long without a break: longer than it takes to see that a wheel slips.
  SimDuration after = std::chrono::milliseconds(80);
  /// Then it is tried again; after twice the time whenever it was in vain, four times at most.
  SimDuration tried_after = std::chrono::seconds(2);

  void describe(ConfigVisitor& v);
};

/// What is known of the drives of the wheels.
struct WheelDrives {
  double bandwidth_Hz;           ///< of the torque loop
  double speed_limit_rad_per_s;  ///< beyond which a drive gives nothing either
};

/// What a frame of the sensors says of the wheels.
struct WheelReadings {
  Vector3 torque;    ///< at the springs [N m]
  Vector3 velocity;  ///< [rad/s]
};

/// Which wheel drive gives no torque any more: what arrives at its spring against what was asked of
/// it, as late as its torque loop is. Drives that are slow, weak or dragged give little, too, but
/// they do so together: one is dead where the others are not. A wheel that slips looks like it and
/// is none, and neither is a drive at the end of its speed. At most one is dead. A dead drive is
/// asked for nothing, so nothing would tell that it lives again: it is tried from time to time.
/// Free of allocation; for the control step.
class DeadDrives {
 public:
  DeadDrives(const DriveLoss& settings, const WheelDrives& wheels);

  /// One command, of the torques asked of the wheels [N m], and what was measured just before.
  /// @param slipping  wheels of which nothing can be told
  void update(SimTime now, const Vector3& asked, const WheelReadings& measured,
              const WheelFlags& slipping) noexcept;

  const WheelFlags& dead() const noexcept { return dead_; }
  std::int64_t deaths() const noexcept { return deaths_; }  ///< found since the start

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.last_);
    visit(self.expected_);
    visit(self.asked_squared_);
    visit(self.arrived_);
    visit(self.fine_until_);
    visit(self.dead_);
    visit(self.tried_at_);
    visit(self.in_vain_);
    visit(self.deaths_);
  }

 private:
  void follow(double dt, const WheelReadings& measured) noexcept;
  bool othersLive(int wheel) const noexcept;

  DriveLoss settings_;
  double lag_;            ///< of the torque loops [s]
  double speed_to_tell_;  ///< [rad/s]
  SimTime last_{};
  Vector3 expected_ = Vector3::Zero();  ///< at the springs [N m]
  /// Of late: the square of what was expected, and its product with what was there [(N m)^2].
  Vector3 asked_squared_ = Vector3::Zero(), arrived_ = Vector3::Zero();
  std::array<SimTime, kWheelCount> fine_until_{};  ///< or unknown
  WheelFlags dead_{};
  SimTime tried_at_{};  ///< the dead one will be
  int in_vain_ = 0;     ///< times in a row
  std::int64_t deaths_ = 0;
};

}  // namespace ballbot
