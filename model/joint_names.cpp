#include "model/joint_names.hpp"

#include "model/state.hpp"

namespace ballbot {

const std::vector<std::string>& jointNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (int i = 1; i <= kWheelCount; ++i) out.push_back("wheel_" + std::to_string(i));
    for (int i = 1; i <= kArmJointCount; ++i) out.push_back("arm_" + std::to_string(i));
    return out;
  }();
  return names;
}

}  // namespace ballbot
