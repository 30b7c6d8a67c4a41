#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// What wheels and arm joints are called in configuration files, in the order of all joints:
/// "wheel_1", ..., "arm_1", ...
const std::vector<std::string>& jointNames();

}  // namespace ballbot
