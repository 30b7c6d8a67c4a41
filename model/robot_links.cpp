#include "model/robot_links.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "model/joint_names.hpp"

namespace ballbot {

RobotLinks::RobotLinks() {
  const std::vector<std::string>& names = jointNames();
  std::copy_n(names.begin(), kWheelCount, wheels.begin());
  std::copy_n(names.begin() + kWheelCount, kArmJointCount, arm.begin());
}

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
  auto key = jointNames().begin();
  for (std::string& wheel : wheels) v.text(may((key++)->c_str(), "one of the wheels"), wheel);
  for (std::size_t i = 0; i < arm.size(); ++i) {
    v.text(may((key++)->c_str(), i == 0 ? "link of the arm that hangs on the base"
                                        : "link of the arm that hangs on the one before"),
           arm[i]);
  }
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
