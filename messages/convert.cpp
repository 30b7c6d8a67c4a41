#include "messages/convert.hpp"

#include <cstddef>

namespace ballbot {
namespace {

template <typename Vector, std::size_t N>
void copyTo(const Vector& from, double (&to)[N]) {
  static_assert(Vector::SizeAtCompileTime == static_cast<int>(N), "sizes must agree");
  Eigen::Map<Vector>{to} = from;
}

template <typename Vector, std::size_t N>
void copyFrom(const double (&from)[N], Vector& to) {
  static_assert(Vector::SizeAtCompileTime == static_cast<int>(N), "sizes must agree");
  to = Eigen::Map<const Vector>{from};
}

}  // namespace

void toMessage(const SensorFrame& frame, std::int64_t tick, ballbot_msgs::sensor_frame& out) {
  out.checksum = 0;
  out.tick = tick;
  out.sim_time_ns = toNs(frame.time);
  copyTo(frame.motor_angle, out.motor_angle);
  copyTo(frame.joint_angle, out.joint_angle);
  copyTo(frame.joint_velocity, out.joint_velocity);
  copyTo(frame.joint_torque, out.joint_torque);
  out.imu_count = frame.imu_count;
  out.imu_time_ns = toNs(frame.imu_time);
  copyTo(frame.accel_B, out.accel_B);
  copyTo(frame.gyro_WB_B, out.gyro_WB_B);
  out.pose_count = frame.pose_count;
  out.pose_time_ns = toNs(frame.pose_time);
  copyTo(frame.pose_W, out.pose_W);
}

void fromMessage(const ballbot_msgs::sensor_frame& message, SensorFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  copyFrom(message.motor_angle, out.motor_angle);
  copyFrom(message.joint_angle, out.joint_angle);
  copyFrom(message.joint_velocity, out.joint_velocity);
  copyFrom(message.joint_torque, out.joint_torque);
  out.imu_count = message.imu_count;
  out.imu_time = simTimeFromNs(message.imu_time_ns);
  copyFrom(message.accel_B, out.accel_B);
  copyFrom(message.gyro_WB_B, out.gyro_WB_B);
  out.pose_count = message.pose_count;
  out.pose_time = simTimeFromNs(message.pose_time_ns);
  copyFrom(message.pose_W, out.pose_W);
}

void toMessage(const ActuatorCommand& command, std::int64_t tick, SimTime time,
               ballbot_msgs::actuator_command& out) {
  out.checksum = 0;
  out.tick = tick;
  out.sim_time_ns = toNs(time);
  copyTo(command.torque, out.torque);
  copyTo(command.position, out.position);
  copyTo(command.velocity, out.velocity);
  copyTo(command.stiffness, out.stiffness);
  copyTo(command.damping, out.damping);
}

void fromMessage(const ballbot_msgs::actuator_command& message, ActuatorCommand& out) {
  copyFrom(message.torque, out.torque);
  copyFrom(message.position, out.position);
  copyFrom(message.velocity, out.velocity);
  copyFrom(message.stiffness, out.stiffness);
  copyFrom(message.damping, out.damping);
}

void toMessage(const TruthFrame& truth, std::int64_t tick, ballbot_msgs::truth_frame& out) {
  out.checksum = 0;
  out.tick = tick;
  out.sim_time_ns = toNs(truth.time);
  copyTo(PositionVector{truth.state.head<kPositionDim>()}, out.q);
  copyTo(VelocityVector{truth.state.tail<kVelocityDim>()}, out.nu);
  copyTo(truth.joint_angle, out.joint_angle);
  copyTo(truth.joint_velocity, out.joint_velocity);
  copyTo(truth.motor_angle, out.motor_angle);
  copyTo(truth.joint_torque, out.joint_torque);
  copyTo(truth.p_WE, out.p_WE);
  copyTo(truth.quat_WE, out.quat_WE);
  copyTo(truth.external_force_W, out.external_force_W);
  copyTo(truth.contact_force_W, out.contact_force_W);
  copyTo(truth.contact_point_W, out.contact_point_W);
  out.contact_phase = static_cast<std::int8_t>(truth.contact_phase);
  out.door_angle = truth.door_angle;
  out.door_rate = truth.door_rate;
}

void fromMessage(const ballbot_msgs::truth_frame& message, TruthFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  out.state.head<kPositionDim>() = Eigen::Map<const PositionVector>{message.q};
  out.state.tail<kVelocityDim>() = Eigen::Map<const VelocityVector>{message.nu};
  copyFrom(message.joint_angle, out.joint_angle);
  copyFrom(message.joint_velocity, out.joint_velocity);
  copyFrom(message.motor_angle, out.motor_angle);
  copyFrom(message.joint_torque, out.joint_torque);
  copyFrom(message.p_WE, out.p_WE);
  copyFrom(message.quat_WE, out.quat_WE);
  copyFrom(message.external_force_W, out.external_force_W);
  copyFrom(message.contact_force_W, out.contact_force_W);
  copyFrom(message.contact_point_W, out.contact_point_W);
  out.contact_phase = static_cast<ContactPhase>(message.contact_phase);
  out.door_angle = message.door_angle;
  out.door_rate = message.door_rate;
}

void toMessage(SimTime time, const StateVector& x, const Eigen::Matrix<double, 10, 1>& sigma,
               bool aligned, ballbot_msgs::state_estimate& out) {
  out.checksum = 0;
  out.tick = 0;
  out.sim_time_ns = toNs(time);
  copyTo(PositionVector{x.head<kPositionDim>()}, out.q);
  copyTo(VelocityVector{x.tail<kVelocityDim>()}, out.nu);
  copyTo(sigma, out.sigma);
  out.aligned = aligned ? 1 : 0;
}

StateVector stateOf(const ballbot_msgs::state_estimate& message) {
  StateVector x;
  x << Eigen::Map<const PositionVector>{message.q}, Eigen::Map<const VelocityVector>{message.nu};
  return x;
}

}  // namespace ballbot
