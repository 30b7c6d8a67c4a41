#include "controller/set_point.hpp"

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {

void SetPoint::describe(ConfigVisitor& v) {
  v.vector(may("ball_position_m", "place of the ball in the plane, x and y in the world"),
           ball_position);
  v.number(may("yaw_rad", "heading; may exceed a turn"), yaw);
  v.vector(
      may("arm_rad", "angle of each arm joint, within its limits; by default the nominal pose"),
      arm);
}

void SetPoint::requireWithinLimits(const ConfigReader& in, const RobotParameters& robot) const {
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    if (arm[i] < link.lower_limit || arm[i] > link.upper_limit) {
      throw InputError(fmt::format("{} puts joint {} ('{}') at {} rad, must be between {} and {}",
                                   in.at("arm_rad"), i + 1, link.name, arm[i], link.lower_limit,
                                   link.upper_limit));
    }
  }
}

}  // namespace ballbot
