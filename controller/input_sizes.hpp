#pragma once

#include "controller/mpc_dimensions.hpp"

// What plans have for inputs: torques, with a force on the end-effector, with force and moment. A
// template on the number of inputs is compiled for these, at the end of the file that defines it.

/// USE(NU) for each of them.
#define BALLBOT_FOR_INPUT_SIZES(USE) \
  USE(kJointCount)                   \
  USE(kJointCount + 3)               \
  USE(kJointCount + kContactDim)
