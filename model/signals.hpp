#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// What the sensors say: the only thing controller code ever learns about the robot.
/// Written by the plant or by real drives, once per communication step.
struct SensorFrame {
  SimTime time{};  ///< when the joint values below were sampled

  JointVector motor_angle = JointVector::Zero();  ///< behind the gear, before the spring [rad]
  JointVector joint_angle =
      JointVector::Zero();  ///< behind the spring: wheels relative to the base, arm joints [rad]
  JointVector joint_velocity =
      JointVector::Zero();  ///< of joint_angle, as the drive computes it [rad/s]
  JointVector joint_torque =
      JointVector::Zero();  ///< spring torque on the joint, from the deflection [N m]

  /// Number of IMU samples so far; it grows by one when accel and gyro below are new.
  std::int64_t imu_count = 0;
  SimTime imu_time{};                 ///< end of the interval over which the IMU sample is averaged
  Vector3 accel_B = Vector3::Zero();  ///< specific force at the IMU, in B [m/s^2]
  Vector3 gyro_WB_B = Vector3::Zero();  ///< angular velocity of B in W, in B [rad/s]

  /// External pose measurement (motion capture), where there is one; counted like IMU samples and
  /// usually some ten milliseconds old when it arrives.
  std::int64_t pose_count = 0;
  SimTime pose_time{};               ///< when the pose was taken
  Vector3 pose_W = Vector3::Zero();  ///< ball centre x, y [m] and yaw [rad], any whole turn
};

/// What the drives are asked to do, until the next command. Each drive applies
/// torque + stiffness (position - joint_angle) + damping (velocity - joint_velocity).
/// With stiffness and damping zero it is a plain torque command.
struct ActuatorCommand {
  JointVector torque = JointVector::Zero();     ///< [N m]
  JointVector position = JointVector::Zero();   ///< [rad]
  JointVector velocity = JointVector::Zero();   ///< [rad/s]
  JointVector stiffness = JointVector::Zero();  ///< [N m/rad]
  JointVector damping = JointVector::Zero();    ///< [N m s/rad]

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.torque);
    visit(self.position);
    visit(self.velocity);
    visit(self.stiffness);
    visit(self.damping);
  }
};

}  // namespace ballbot
