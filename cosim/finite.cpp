#include "cosim/finite.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace ballbot {
namespace {

std::string jointText(int joint) {
  return joint < kWheelCount ? fmt::format("wheel {}", joint + 1)
                             : fmt::format("arm joint {}", joint - kWheelCount + 1);
}

bool namesJoint(const char* what, const JointVector& values, std::string& text) {
  if (values.allFinite()) return false;
  for (int i = 0; i < kJointCount; ++i) {
    if (!std::isfinite(values[i])) {
      text = fmt::format("{} of {} is {}", what, jointText(i), values[i]);
      return true;
    }
  }
  return false;
}

bool namesAxis(const char* what, const Vector3& values, std::string& text) {
  if (values.allFinite()) return false;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(values[i])) {
      text = fmt::format("{}, axis {}, is {}", what, "xyz"[i], values[i]);
      return true;
    }
  }
  return false;
}

}  // namespace

std::string firstNonFinite(const ActuatorCommand& command) {
  std::string text;
  (void)(namesJoint("torque", command.torque, text) ||
         namesJoint("position set-point", command.position, text) ||
         namesJoint("velocity set-point", command.velocity, text) ||
         namesJoint("stiffness", command.stiffness, text) ||
         namesJoint("damping", command.damping, text));
  return text;
}

std::string firstNonFinite(const SensorFrame& sensors) {
  std::string text;
  (void)(namesJoint("motor angle", sensors.motor_angle, text) ||
         namesJoint("joint angle", sensors.joint_angle, text) ||
         namesJoint("joint velocity", sensors.joint_velocity, text) ||
         namesJoint("joint torque", sensors.joint_torque, text) ||
         namesAxis("specific force", sensors.accel_B, text) ||
         namesAxis("angular velocity", sensors.gyro_WB_B, text) ||
         namesAxis("external pose", sensors.pose_W, text));
  return text;
}

}  // namespace ballbot
