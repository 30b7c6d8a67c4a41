#include "model/robot_links.hpp"

#include <map>

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {

std::vector<std::string> RobotLinks::bodies() const {
  std::vector<std::string> out{base, ball};
  out.insert(out.end(), wheels.begin(), wheels.end());
  out.insert(out.end(), arm.begin(), arm.end());
  return out;
}

std::vector<std::string> RobotLinks::all() const {
  std::vector<std::string> out = bodies();
  out.push_back(end_effector);
  out.push_back(imu);
  return out;
}

void RobotLinks::describe(ConfigVisitor& v) {
  v.text(may("base", "the root, with its origin at the ball's centre"), base);
  v.text(may("ball", "the ball"), ball);
  v.text(may("wheel_1", "first wheel"), wheels[0]);
  v.text(may("wheel_2", "second wheel"), wheels[1]);
  v.text(may("wheel_3", "third wheel"), wheels[2]);
  v.text(may("arm_1", "link of the arm that hangs on the base"), arm[0]);
  v.text(may("arm_2", "link that hangs on the first"), arm[1]);
  v.text(may("arm_3", "link that hangs on the second"), arm[2]);
  v.text(may("end_effector", "frame on the last link of the arm"), end_effector);
  v.text(may("imu", "frame on the base"), imu);
  v.check([this](const ConfigReader& in) {
    std::map<std::string, int> times;
    for (const std::string& name : all()) {
      if (++times[name] < 2) continue;
      throw InputError(
          fmt::format("{}: '{}' stands for two parts of the robot, must be one", in.path(), name));
    }
  });
}

}  // namespace ballbot
