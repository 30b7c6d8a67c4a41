#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// What the robot should stay within.
struct RobotLimits {
  double wheel_torque = 0, arm_torque = 0;                                 ///< of the command [N m]
  ArmVector arm_lower = ArmVector::Zero(), arm_upper = ArmVector::Zero();  ///< [rad]
  double arm_rate = 0;                                                     ///< [rad/s]
  double tilt = 0;                                                         ///< [rad]
};

/// How close the run came to its limits: the smallest distance to each kind of limit, negative
/// where one was crossed. Torques as commanded, motion as it truly was.
class LimitMargins {
 public:
  /// @param from  times before do not count
  LimitMargins(const RobotLimits& limits, SimTime from) : limits_(limits), from_(from) {}

  void add(const TruthFrame& truth, const ActuatorCommand& command);

  /// least_wheel_torque_margin_Nm, least_arm_torque_margin_Nm, least_arm_position_margin_rad,
  /// least_arm_rate_margin_rad_per_s, least_tilt_margin_deg; absent before `from`.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  RobotLimits limits_;
  SimTime from_;
  bool any_ = false;
  double wheel_torque_ = 1e300, arm_torque_ = 1e300, arm_position_ = 1e300, arm_rate_ = 1e300,
         tilt_ = 1e300;
};

}  // namespace ballbot
