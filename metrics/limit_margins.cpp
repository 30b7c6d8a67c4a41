#include "metrics/limit_margins.hpp"

#include <algorithm>

#include "core/angle.hpp"
#include "metrics/balance_metrics.hpp"

namespace ballbot {
namespace {}  // namespace

void LimitMargins::add(const TruthFrame& truth, const ActuatorCommand& command) {
  if (truth.time < from_) return;
  any_ = true;
  const ArmVector arm = truth.state.segment<kArmJointCount>(kArm1);
  const ArmVector rate = truth.state.segment<kArmJointCount>(kPositionDim + kArmRate1);
  wheel_torque_ =
      std::min(wheel_torque_,
               limits_.wheel_torque - command.torque.head<kWheelCount>().cwiseAbs().maxCoeff());
  arm_torque_ =
      std::min(arm_torque_,
               limits_.arm_torque - command.torque.tail<kArmJointCount>().cwiseAbs().maxCoeff());
  arm_position_ = std::min(arm_position_, std::min((arm - limits_.arm_lower).minCoeff(),
                                                   (limits_.arm_upper - arm).minCoeff()));
  arm_rate_ = std::min(arm_rate_, limits_.arm_rate - rate.cwiseAbs().maxCoeff());
  tilt_ = std::min(tilt_, limits_.tilt - tiltAngle(truth.state));
}

std::map<std::string, double> LimitMargins::values() const {
  if (!any_) return {};
  return {{"least_wheel_torque_margin_Nm", wheel_torque_},
          {"least_arm_torque_margin_Nm", arm_torque_},
          {"least_arm_position_margin_rad", arm_position_},
          {"least_arm_rate_margin_rad_per_s", arm_rate_},
          {"least_tilt_margin_deg", tilt_ * kDegPerRad}};
}

std::vector<std::string> LimitMargins::names() {
  return {"least_wheel_torque_margin_Nm", "least_arm_torque_margin_Nm",
          "least_arm_position_margin_rad", "least_arm_rate_margin_rad_per_s",
          "least_tilt_margin_deg"};
}

}  // namespace ballbot
