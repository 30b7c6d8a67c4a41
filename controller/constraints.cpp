#include "controller/constraints.hpp"

#include "core/angle.hpp"
#include "core/config_reader.hpp"

namespace ballbot {
namespace {

constexpr double kWheelRateShare = 0.7;

void readBarrier(ConfigReader& in, RelaxedBarrier& barrier) {
  barrier.mu = in.numberOr("mu", barrier.mu, {0, 1e6});
  barrier.delta = in.numberOr("delta", barrier.delta, {1e-6, 1e6});
}

}  // namespace

Constraints::Constraints(const RobotParameters& robot)
    : wheel_rate_limit(kWheelRateShare * robot.wheel_speed_limit) {
  torque_limit << Vector3::Constant(robot.wheel_torque_limit),
      Vector3::Constant(robot.arm_torque_limit);
  for (int i = 0; i < kArmJointCount; ++i) {
    arm_lower[i] = robot.arm[i].lower_limit;
    arm_upper[i] = robot.arm[i].upper_limit;
  }
}

Constraints Constraints::read(ConfigReader& in, const RobotParameters& robot) {
  Constraints c(robot);
  if (in.has("torque_limits")) {
    ConfigReader torque = in.child("torque_limits");
    readBarrier(torque, c.torque);
    c.torque_limit *= torque.numberOr("share_of_limit", 1, {0.1, 1});
    torque.finish();
  }
  if (in.has("friction_cone")) {
    ConfigReader cone = in.child("friction_cone");
    readBarrier(cone, c.cone);
    c.friction = cone.numberOr("friction", c.friction, {0.01, 10});
    c.cone_epsilon = cone.numberOr("epsilon_N", c.cone_epsilon, {1e-3, 1e3});
    cone.finish();
  }
  if (in.has("arm_position_limits")) {
    ConfigReader arm = in.child("arm_position_limits");
    readBarrier(arm, c.arm_position);
    arm.finish();
  }
  if (in.has("arm_rate_limits")) {
    ConfigReader rate = in.child("arm_rate_limits");
    readBarrier(rate, c.arm_rate);
    c.arm_rate_limit = rate.numberOr("limit_rad_per_s", c.arm_rate_limit, {0.1, 100});
    rate.finish();
  }
  if (in.has("wheel_rate_limits")) {
    ConfigReader rate = in.child("wheel_rate_limits");
    readBarrier(rate, c.wheel_rate);
    c.wheel_rate_limit =
        robot.wheel_speed_limit * rate.numberOr("share_of_limit", kWheelRateShare, {0.1, 1});
    rate.finish();
  }
  if (in.has("tilt_limit")) {
    ConfigReader tilt = in.child("tilt_limit");
    readBarrier(tilt, c.tilt);
    c.tilt_limit = kRadPerDeg * tilt.numberOr("limit_deg", c.tilt_limit / kRadPerDeg, {1, 80});
    tilt.finish();
  }
  in.finish();
  return c;
}

}  // namespace ballbot
