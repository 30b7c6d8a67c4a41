#pragma once

// How many wheels and arm joints the robot has that this is compiled for: the size of all that is
// fixed in the kernels. Set by CMake (BALLBOT_ARM_JOINTS); who compiles without it gets the shipped
// robot.

#ifndef BALLBOT_WHEELS
#define BALLBOT_WHEELS 3
#endif
#ifndef BALLBOT_ARM_JOINTS
#define BALLBOT_ARM_JOINTS 3
#endif

namespace ballbot {

/// No robot has more.
constexpr int kMaxWheels = 4, kMaxArmJoints = 7;

}  // namespace ballbot
