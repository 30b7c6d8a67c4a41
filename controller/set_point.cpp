#include "controller/set_point.hpp"

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {

SetPoint SetPoint::read(ConfigReader& in, const RobotParameters& robot) {
  SetPoint out;
  const auto position = in.numbersOr<2>("ball_position_m", {0, 0});
  out.ball_position << position[0], position[1];
  out.yaw = in.numberOr("yaw_rad", 0);
  const Vector3& nominal = robot.nominal_arm;
  const auto arm = in.numbersOr<3>("arm_rad", {nominal.x(), nominal.y(), nominal.z()});
  out.arm << arm[0], arm[1], arm[2];
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    if (out.arm[i] < link.lower_limit || out.arm[i] > link.upper_limit) {
      throw InputError(fmt::format("{} puts joint {} ('{}') at {} rad, must be between {} and {}",
                                   in.at("arm_rad"), i + 1, link.name, out.arm[i], link.lower_limit,
                                   link.upper_limit));
    }
  }
  in.finish();
  return out;
}

}  // namespace ballbot
