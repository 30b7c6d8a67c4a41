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

/// What no number of its kind exceeds: far more than any robot reaches, even one that falls or
/// rolls for a day, and far less than where arithmetic breaks down.
struct Bound {
  double largest;
  const char* unit;
};
constexpr Bound kAngle{1e6, " rad"}, kRate{1e5, " rad/s"}, kTorque{1e5, " N m"};
constexpr Bound kAcceleration{1e6, " m/s^2"}, kForce{1e7, " N"};
constexpr Bound kPose{1e6, ""};  // metres and radians

// A bench that skips periods counts time by its own cycles, a little ahead of the master.
constexpr SimDuration kMostAhead{100'000'000};
constexpr std::int64_t kHighestCount = 1'000'000'000'000;

bool within(double value, const Bound& bound) { return std::abs(value) <= bound.largest; }

std::string beyond(double value, const Bound& bound) {
  if (!std::isfinite(value)) return fmt::format("is {}", value);
  return fmt::format("is {}{}, beyond {:g}", value, bound.unit, bound.largest);
}

bool jointBeyond(const char* what, const JointVector& values, const Bound& bound,
                 std::string& text) {
  for (int i = 0; i < kJointCount; ++i) {
    if (within(values[i], bound)) continue;
    text = fmt::format("{} of {} {}", what, jointText(i), beyond(values[i], bound));
    return true;
  }
  return false;
}

bool axisBeyond(const char* what, const Vector3& values, const Bound& bound, std::string& text) {
  for (int i = 0; i < 3; ++i) {
    if (within(values[i], bound)) continue;
    text = fmt::format("{}, axis {}, {}", what, "xyz"[i], beyond(values[i], bound));
    return true;
  }
  return false;
}

template <typename Values>
bool anyBeyond(const char* what, const Values& values, const Bound& bound, std::string& text) {
  for (int i = 0; i < values.size(); ++i) {
    if (within(values[i], bound)) continue;
    text = fmt::format("{}, number {}, {}", what, i + 1, beyond(values[i], bound));
    return true;
  }
  return false;
}

bool isAhead(const char* what, SimTime time, SimTime now, std::string& text) {
  if (time <= now + kMostAhead) return false;
  text = fmt::format("{} is {}, at {}", what, toText(time), toText(now));
  return true;
}

bool isNoCount(const char* what, std::int64_t count, std::string& text) {
  if (count >= 0 && count <= kHighestCount) return false;
  text = fmt::format("{} is {}, must be 0 to {}", what, count, kHighestCount);
  return true;
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

std::string firstImpossible(const SensorFrame& f, SimTime now) {
  std::string text;
  (void)(isAhead("joint time", f.time, now, text) || isAhead("IMU time", f.imu_time, now, text) ||
         isAhead("pose time", f.pose_time, now, text) ||
         isNoCount("IMU count", f.imu_count, text) || isNoCount("pose count", f.pose_count, text) ||
         jointBeyond("motor angle", f.motor_angle, kAngle, text) ||
         jointBeyond("joint angle", f.joint_angle, kAngle, text) ||
         jointBeyond("joint velocity", f.joint_velocity, kRate, text) ||
         jointBeyond("joint torque", f.joint_torque, kTorque, text) ||
         axisBeyond("specific force", f.accel_B, kAcceleration, text) ||
         axisBeyond("angular velocity", f.gyro_WB_B, kRate, text) ||
         axisBeyond("external pose", f.pose_W, kPose, text));
  return text;
}

std::string firstImpossible(const TruthFrame& f, SimTime now) {
  std::string text;
  const auto phase = static_cast<int>(f.contact_phase);
  if (phase < 0 || phase > static_cast<int>(ContactPhase::kSliding)) {
    return fmt::format("contact phase is {}, must be 0 to 2", phase);
  }
  (void)(isAhead("time of the true state", f.time, now, text) ||
         anyBeyond("true state", f.state, kPose, text) ||
         jointBeyond("true joint angle", f.joint_angle, kAngle, text) ||
         jointBeyond("true joint velocity", f.joint_velocity, kRate, text) ||
         jointBeyond("true motor angle", f.motor_angle, kAngle, text) ||
         jointBeyond("true joint torque", f.joint_torque, kTorque, text) ||
         axisBeyond("end-effector position", f.p_WE, kPose, text) ||
         anyBeyond("end-effector orientation", f.quat_WE, kPose, text) ||
         axisBeyond("push", f.external_force_W, kForce, text) ||
         axisBeyond("contact force", f.contact_force_W, kForce, text) ||
         axisBeyond("contact point", f.contact_point_W, kPose, text) ||
         anyBeyond("door", Eigen::Vector2d{f.door_angle, f.door_rate}, kRate, text));
  return text;
}

}  // namespace ballbot
