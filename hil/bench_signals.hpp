#pragma once

#include <array>
#include <cstdint>

namespace ballbot {

/// Drives of the bench in the order of the robot's joints: wheels 1 to 3, then arm joints 1 to 3.
constexpr int kDriveCount = 6;
using DriveArray = std::array<double, kDriveCount>;

/// What one cycle has measured, SI units, joint side; frames as in model/signals.hpp.
struct BenchSample {
  DriveArray joint_angle{}, motor_angle{}, joint_velocity{}, joint_torque{};
  DriveArray motor_torque{};   ///< by the motor's current, behind the gear; 0 where not mapped
  std::int64_t imu_count = 0;  ///< IMU samples so far
  std::int64_t cycle = 0;      ///< of the master: periods that a late loop skips do not count
  std::int64_t imu_cycle = 0;  ///< cycle in which the last IMU sample arrived
  std::array<double, 3> accel{}, gyro{};
};

/// What the controller asks of the drives: torque + stiffness (position - q) + damping (velocity -
/// dq).
struct BenchCommand {
  DriveArray torque{}, position{}, velocity{}, stiffness{}, damping{};
};

}  // namespace ballbot
