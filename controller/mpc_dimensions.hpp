#pragma once

#include "model/state.hpp"

namespace ballbot {

constexpr int kFilterDim = kWheelCount;                  ///< low-passed wheel torques x_f
constexpr int kMpcStateDim = kStateDim + kFilterDim;     ///< (q, nu, x_f)
constexpr int kContactDim = 6;                           ///< force and moment on the end-effector
constexpr int kMpcInputDim = kJointCount + kContactDim;  ///< (tau, force, moment)
using ContactInput = Eigen::Matrix<double, kContactDim, 1>;  ///< both in C [N, N m]

}  // namespace ballbot
