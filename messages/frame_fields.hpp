// Written by write_messages from model/signal_table.cpp. Change it there.
#pragma once

#include "ballbot_msgs/actuator_command.hpp"
#include "ballbot_msgs/plan_report.hpp"
#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/truth_frame.hpp"

namespace ballbot {

// What a message carries of its frame, field by field in the order of the frame's signals;
// and how many of its fields have a size that depends on the robot.

template <typename Message>
struct FieldSizes;

template <typename Visitor>
void visitFields(ballbot_msgs::actuator_command& m, Visitor&& visit) {
  visit(m.torque);
  visit(m.position);
  visit(m.velocity);
  visit(m.stiffness);
  visit(m.damping);
}
template <>
struct FieldSizes<ballbot_msgs::actuator_command> {
  static constexpr int kPerJoint = 5, kPerCoordinate = 0;
  template <typename M>
  static void setCounts(M&& m, int joints, int coordinates) {
    m.joints = joints;
    (void)coordinates;
  }
};

template <typename Visitor>
void visitFields(ballbot_msgs::plan_report& m, Visitor&& visit) {
  visit(m.acts_from_ns);
  visit(m.accepted);
  visit(m.iterations);
  visit(m.cost);
  visit(m.step_length);
  visit(m.constraint_violation);
  visit(m.contact_state);
  visit(m.contact_asked_W);
  visit(m.contact_counted_on_W);
  visit(m.status);
  visit(m.fallback);
  visit(m.predicted_decrease);
  visit(m.regularisation);
  visit(m.cost_terms);
}
template <>
struct FieldSizes<ballbot_msgs::plan_report> {
  static constexpr int kPerJoint = 0, kPerCoordinate = 0;
  template <typename M>
  static void setCounts(M&& m, int joints, int coordinates) {
    (void)joints;
    (void)coordinates;
    (void)m;
  }
};

template <typename Visitor>
void visitFields(ballbot_msgs::sensor_frame& m, Visitor&& visit) {
  visit(m.motor_angle);
  visit(m.joint_angle);
  visit(m.joint_velocity);
  visit(m.joint_torque);
  visit(m.imu_count);
  visit(m.imu_time_ns);
  visit(m.accel_B);
  visit(m.gyro_WB_B);
  visit(m.pose_count);
  visit(m.pose_time_ns);
  visit(m.pose_W);
}
template <>
struct FieldSizes<ballbot_msgs::sensor_frame> {
  static constexpr int kPerJoint = 4, kPerCoordinate = 0;
  template <typename M>
  static void setCounts(M&& m, int joints, int coordinates) {
    m.joints = joints;
    (void)coordinates;
  }
};

template <typename Visitor>
void visitFields(ballbot_msgs::state_estimate& m, Visitor&& visit) {
  visit(m.q);
  visit(m.nu);
  visit(m.sigma);
  visit(m.contact_force_W);
  visit(m.aligned);
}
template <>
struct FieldSizes<ballbot_msgs::state_estimate> {
  static constexpr int kPerJoint = 0, kPerCoordinate = 2;
  template <typename M>
  static void setCounts(M&& m, int joints, int coordinates) {
    (void)joints;
    m.coordinates = coordinates;
  }
};

template <typename Visitor>
void visitFields(ballbot_msgs::truth_frame& m, Visitor&& visit) {
  visit(m.q);
  visit(m.nu);
  visit(m.joint_angle);
  visit(m.joint_velocity);
  visit(m.motor_angle);
  visit(m.joint_torque);
  visit(m.p_WE);
  visit(m.quat_WE);
  visit(m.external_force_W);
  visit(m.contact_force_W);
  visit(m.contact_point_W);
  visit(m.contact_phase);
  visit(m.door_angle);
  visit(m.door_rate);
}
template <>
struct FieldSizes<ballbot_msgs::truth_frame> {
  static constexpr int kPerJoint = 4, kPerCoordinate = 2;
  template <typename M>
  static void setCounts(M&& m, int joints, int coordinates) {
    m.joints = joints;
    m.coordinates = coordinates;
  }
};

}  // namespace ballbot
