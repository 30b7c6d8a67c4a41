#pragma once

#include <Eigen/Core>

#include "model/robot_size.hpp"

namespace ballbot {

// The whole-body state as estimator and controller know it. Frames: W world, z up, floor at z = 0;
// K ball centre, axes of W; B base, origin at K, x forward.
//
//   q  = (px, py | yaw, pitch, roll | q1, q2, ...)   R_WB = Rz(yaw) Ry(pitch) Rx(roll)
//   nu = (vx, vy | w_WB_B | dq1, dq2, ...)
//
// px, py: position of K in W [m]; vx, vy its velocity in W [m/s]; w_WB_B: angular velocity of the
// base in W, expressed in B [rad/s], which is what the gyroscope measures. nu is not dq/dt: the
// angular parts differ by the Euler rate matrix (model/frames.hpp).

enum PositionIndex : int { kBallX, kBallY, kYaw, kPitch, kRoll, kArm1 };  ///< and the arm's others
enum VelocityIndex : int { kBallVx, kBallVy, kOmegaX, kOmegaY, kOmegaZ, kArmRate1 };

/// Actuators in the order used everywhere: wheels, then arm joints.
constexpr int kWheelCount = BALLBOT_WHEELS;
constexpr int kArmJointCount = BALLBOT_ARM_JOINTS;
constexpr int kJointCount = kWheelCount + kArmJointCount;

constexpr int kPositionDim = kArm1 + kArmJointCount;
constexpr int kVelocityDim = kArmRate1 + kArmJointCount;
constexpr int kStateDim = kPositionDim + kVelocityDim;

using Vector3 = Eigen::Matrix<double, 3, 1>;
using Matrix3 = Eigen::Matrix<double, 3, 3>;
using PositionVector = Eigen::Matrix<double, kPositionDim, 1>;
using VelocityVector = Eigen::Matrix<double, kVelocityDim, 1>;
using StateVector = Eigen::Matrix<double, kStateDim, 1>;    ///< (q, nu)
using JointVector = Eigen::Matrix<double, kJointCount, 1>;  ///< one value per actuator
using WheelVector = Eigen::Matrix<double, kWheelCount, 1>;
using ArmVector = Eigen::Matrix<double, kArmJointCount, 1>;

}  // namespace ballbot
