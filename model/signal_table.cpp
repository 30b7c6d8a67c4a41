#include "model/signal_table.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

// A contiguous run of doubles inside a vector member.
#define BALLBOT_REALS(frame, field, name, size, first, unit, text, member)                       \
  Signal<frame> {                                                                                \
    field, name, size, SignalKind::kReal, unit, text,                                            \
        [](const frame& f, double* to) { std::copy_n((member).data() + (first), size, to); },    \
        [](frame& f, const double* from) { std::copy_n(from, size, (member).data() + (first)); } \
  }
#define BALLBOT_NUMBER(frame, field, name, unit, text, member) \
  Signal<frame> {                                              \
    field, name, 1, SignalKind::kReal, unit, text,             \
        [](const frame& f, double* to) { *to = member; },      \
        [](frame& f, const double* from) { member = *from; }   \
  }
#define BALLBOT_COUNT(frame, field, name, text, member)                             \
  Signal<frame> {                                                                   \
    field, name, 1, SignalKind::kCount, "", text,                                   \
        [](const frame& f, double* to) { *to = static_cast<double>(member); },      \
        [](frame& f, const double* from) {                                          \
          member = static_cast<decltype(member)>(static_cast<std::int64_t>(*from)); \
        }                                                                           \
  }
#define BALLBOT_TIME(frame, field, name, text, member)                                          \
  Signal<frame> {                                                                               \
    field, name, 1, SignalKind::kTime, "s", text,                                               \
        [](const frame& f, double* to) { *to = static_cast<double>(toNs(member)) / 1e9; },      \
        [](frame& f, const double* from) { member = simTimeFromNs(std::llround(1e9 * *from)); } \
  }

}  // namespace

const std::vector<Signal<ActuatorCommand>>& commandSignals() {
  static_assert(kJointCount == 6, "the descriptions below name six joints");
  static const std::vector<Signal<ActuatorCommand>> signals = {
      BALLBOT_REALS(ActuatorCommand, "torque", "torque", 6, 0, "N m",
                    "feedforward torque at each joint: wheels 1 to 3, then arm joints 1 to 3",
                    f.torque),
      BALLBOT_REALS(ActuatorCommand, "position", "position", 6, 0, "rad",
                    "set-point of each joint's angle", f.position),
      BALLBOT_REALS(ActuatorCommand, "velocity", "velocity", 6, 0, "rad/s",
                    "set-point of each joint's rate", f.velocity),
      BALLBOT_REALS(ActuatorCommand, "stiffness", "stiffness", 6, 0, "N m/rad",
                    "gain on (position - joint angle) inside each drive", f.stiffness),
      BALLBOT_REALS(ActuatorCommand, "damping", "damping", 6, 0, "N m s/rad",
                    "gain on (velocity - joint rate) inside each drive", f.damping),
  };
  return signals;
}

const std::vector<Signal<ExternalForces>>& externalForceSignals() {
  static const std::vector<Signal<ExternalForces>> signals = {
      BALLBOT_REALS(ExternalForces, "", "base_W", 3, 0, "N", "force on the base, in the world",
                    f.base_force_W),
      BALLBOT_REALS(ExternalForces, "", "base_point_B", 3, 0, "m",
                    "where it acts, from the ball centre, in the base frame", f.base_point_B),
      BALLBOT_REALS(ExternalForces, "", "end_effector_W", 3, 0, "N",
                    "force on the end-effector, in the world", f.end_effector_force_W),
  };
  return signals;
}

const std::vector<Signal<SensorFrame>>& sensorSignals() {
  static const std::vector<Signal<SensorFrame>> signals = {
      BALLBOT_REALS(
          SensorFrame, "motor_angle", "motor_angle", 6, 0, "rad",
          "encoders behind the gear, before the spring: wheels 1 to 3, then arm joints 1 to 3",
          f.motor_angle),
      BALLBOT_REALS(SensorFrame, "joint_angle", "joint_angle", 6, 0, "rad",
                    "encoders behind the spring; wheels relative to the base", f.joint_angle),
      BALLBOT_REALS(SensorFrame, "joint_velocity", "joint_velocity", 6, 0, "rad/s",
                    "rate of joint_angle as the drive computes it", f.joint_velocity),
      BALLBOT_REALS(SensorFrame, "joint_torque", "joint_torque", 6, 0, "N m",
                    "spring torque on the joint, from the deflection", f.joint_torque),
      BALLBOT_COUNT(SensorFrame, "imu_count", "imu_count",
                    "IMU samples so far; has grown when accel_B and gyro_WB_B are new",
                    f.imu_count),
      BALLBOT_TIME(SensorFrame, "imu_time_ns", "imu_time",
                   "end of the interval the IMU sample is averaged over", f.imu_time),
      BALLBOT_REALS(SensorFrame, "accel_B", "accel_B", 3, 0, "m/s^2",
                    "specific force at the IMU, in the base frame", f.accel_B),
      BALLBOT_REALS(SensorFrame, "gyro_WB_B", "gyro_WB_B", 3, 0, "rad/s",
                    "angular velocity of the base in the world, in the base frame", f.gyro_WB_B),
      BALLBOT_COUNT(SensorFrame, "pose_count", "pose_count",
                    "external pose samples so far; 0 without such a measurement", f.pose_count),
      BALLBOT_TIME(SensorFrame, "pose_time_ns", "pose_time", "when the external pose was taken",
                   f.pose_time),
      BALLBOT_REALS(SensorFrame, "pose_W", "pose_position_W", 2, 0, "m",
                    "externally measured ball centre x, y in the world", f.pose_W),
      BALLBOT_REALS(SensorFrame, "pose_W", "pose_yaw_W", 1, 2, "rad",
                    "externally measured yaw, any whole turn", f.pose_W),
  };
  return signals;
}

const std::vector<Signal<TruthFrame>>& truthSignals() {
  static const std::vector<Signal<TruthFrame>> signals = {
      BALLBOT_REALS(TruthFrame, "q", "ball_position_W", 2, kBallX, "m",
                    "true position x, y of the ball centre in the world", f.state),
      BALLBOT_REALS(TruthFrame, "q", "base_angles", 3, kYaw, "rad",
                    "true yaw (continuous), pitch, roll of the base", f.state),
      BALLBOT_REALS(TruthFrame, "q", "arm_angle", 3, kArm1, "rad", "true angles of the arm joints",
                    f.state),
      BALLBOT_REALS(TruthFrame, "nu", "ball_velocity_W", 2, kPositionDim + kBallVx, "m/s",
                    "true velocity x, y of the ball centre in the world", f.state),
      BALLBOT_REALS(TruthFrame, "nu", "base_rate_B", 3, kPositionDim + kOmegaX, "rad/s",
                    "true angular velocity of the base in the world, in the base frame", f.state),
      BALLBOT_REALS(TruthFrame, "nu", "arm_rate", 3, kPositionDim + kArmRate1, "rad/s",
                    "true rates of the arm joints", f.state),
      BALLBOT_REALS(TruthFrame, "joint_angle", "joint_angle", 6, 0, "rad",
                    "true joint angles: wheels 1 to 3, integrated, relative to the base, then arm",
                    f.joint_angle),
      BALLBOT_REALS(TruthFrame, "joint_velocity", "joint_velocity", 6, 0, "rad/s",
                    "true joint rates", f.joint_velocity),
      BALLBOT_REALS(TruthFrame, "motor_angle", "motor_angle", 6, 0, "rad",
                    "true rotor angles behind the gear, before the spring", f.motor_angle),
      BALLBOT_REALS(TruthFrame, "joint_torque", "joint_torque", 6, 0, "N m",
                    "torque that the spring, or the ideal actuator, applies", f.joint_torque),
      BALLBOT_REALS(TruthFrame, "p_WE", "p_WE", 3, 0, "m",
                    "true end-effector position in the world", f.p_WE),
      BALLBOT_REALS(TruthFrame, "quat_WE", "quat_WE", 4, 0, "",
                    "true end-effector orientation in the world: w, x, y, z", f.quat_WE),
      BALLBOT_REALS(TruthFrame, "external_force_W", "external_force_W", 3, 0, "N",
                    "sum of pushes, in the world", f.external_force_W),
      BALLBOT_REALS(TruthFrame, "contact_force_W", "contact_force_W", 3, 0, "N",
                    "surroundings on the end-effector, in the world", f.contact_force_W),
      BALLBOT_REALS(TruthFrame, "contact_point_W", "contact_point_W", 3, 0, "m",
                    "where that force acts, in the world; without contact p_WE", f.contact_point_W),
      BALLBOT_COUNT(TruthFrame, "contact_phase", "contact_phase",
                    "what the end-effector does: 0 touches nothing, 1 sticks, 2 slides",
                    f.contact_phase),
      BALLBOT_NUMBER(TruthFrame, "door_angle", "door_angle", "rad",
                     "true angle of the door from closed; 0 without a door", f.door_angle),
      BALLBOT_NUMBER(TruthFrame, "door_rate", "door_rate", "rad/s",
                     "true rate of the door's angle; 0 without a door", f.door_rate),
  };
  return signals;
}

#undef BALLBOT_REALS
#undef BALLBOT_NUMBER
#undef BALLBOT_COUNT
#undef BALLBOT_TIME

}  // namespace ballbot
