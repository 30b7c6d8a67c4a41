#include "controller/cost_terms.hpp"

namespace ballbot {

const char* costTermName(CostTerm term) {
  switch (term) {
    case kEndEffectorPositionCost:
      return "ee_position";
    case kEndEffectorOrientationCost:
      return "ee_orientation";
    case kEndEffectorTwistCost:
      return "ee_twist";
    case kBallPositionCost:
      return "ball_position";
    case kYawCost:
      return "yaw";
    case kBallVelocityCost:
      return "ball_velocity";
    case kBaseRateCost:
      return "base_rate";
    case kArmPositionCost:
      return "arm_position";
    case kArmRateCost:
      return "arm_rate";
    case kWheelTorqueCost:
      return "wheel_torque";
    case kArmTorqueCost:
      return "arm_torque";
    case kContactForceCost:
      return "contact_force";
    case kContactMomentCost:
      return "contact_moment";
    case kTorqueLimitCost:
      return "torque_limits";
    case kFrictionConeCost:
      return "friction_cone";
    case kArmPositionLimitCost:
      return "arm_position_limits";
    case kArmRateLimitCost:
      return "arm_rate_limits";
    case kWheelRateLimitCost:
      return "wheel_rate_limits";
    case kTiltLimitCost:
      return "tilt_limit";
    case kTerminalCost:
      return "terminal";
    case kCostTermCount:
      break;
  }
  return "";
}

}  // namespace ballbot
