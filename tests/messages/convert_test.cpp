#include "messages/convert.hpp"

#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "messages/wire.hpp"

namespace ballbot {
namespace {

// Values whose bits are easily lost on the way: smallest, largest, negative zero.
double awkward(int i) {
  constexpr double kValues[] = {-0.0, std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::max(), 0.1, -1.0 / 3.0};
  return kValues[i % 5] + (i % 5 == 3 ? i : 0);
}

template <typename Vector>
void fill(Vector& v, int& i) {
  for (Eigen::Index k = 0; k < v.size(); ++k) v[k] = awkward(i++);
}

template <typename Vector>
bool sameBits(const Vector& a, const Vector& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

template <typename Message>
Message overTheWire(const Message& message) {
  Bytes bytes;
  encodeMessage(message, bytes);
  Message back{};
  EXPECT_TRUE(decodeMessage(bytes.data(), bytes.size(), back));
  return back;
}

TEST(Convert, ASensorFrameKeepsEveryBit) {
  SensorFrame frame;
  int i = 0;
  fill(frame.motor_angle, i);
  fill(frame.joint_angle, i);
  fill(frame.joint_velocity, i);
  fill(frame.joint_torque, i);
  fill(frame.accel_B, i);
  fill(frame.gyro_WB_B, i);
  fill(frame.pose_W, i);
  frame.pose_count = 3;
  frame.pose_time = simTimeFromNs(11);
  frame.time = simTimeFromNs(1'234'567'891);
  frame.imu_count = 7;
  frame.imu_time = simTimeFromNs(-5);

  ballbot_msgs::sensor_frame message{};
  toMessage(frame, 42, message);
  EXPECT_EQ(message.tick, 42);
  SensorFrame back;
  ASSERT_TRUE(fromMessage(overTheWire(message), back));
  EXPECT_EQ(back.time, frame.time);
  EXPECT_EQ(back.imu_count, 7);
  EXPECT_EQ(back.imu_time, frame.imu_time);
  EXPECT_TRUE(sameBits(back.motor_angle, frame.motor_angle));
  EXPECT_TRUE(sameBits(back.joint_angle, frame.joint_angle));
  EXPECT_TRUE(sameBits(back.joint_velocity, frame.joint_velocity));
  EXPECT_TRUE(sameBits(back.joint_torque, frame.joint_torque));
  EXPECT_TRUE(sameBits(back.accel_B, frame.accel_B));
  EXPECT_TRUE(sameBits(back.gyro_WB_B, frame.gyro_WB_B));
  EXPECT_EQ(back.pose_count, 3);
  EXPECT_EQ(back.pose_time, frame.pose_time);
  EXPECT_TRUE(sameBits(back.pose_W, frame.pose_W));
}

TEST(Convert, AnActuatorCommandKeepsEveryBit) {
  ActuatorCommand command;
  int i = 1;
  fill(command.torque, i);
  fill(command.position, i);
  fill(command.velocity, i);
  fill(command.stiffness, i);
  fill(command.damping, i);

  ballbot_msgs::actuator_command message{};
  toMessage(command, 3, simTimeFromNs(400'000), message);
  EXPECT_EQ(message.sim_time_ns, 400'000);
  ActuatorCommand back;
  ASSERT_TRUE(fromMessage(overTheWire(message), back));
  EXPECT_TRUE(sameBits(back.torque, command.torque));
  EXPECT_TRUE(sameBits(back.position, command.position));
  EXPECT_TRUE(sameBits(back.velocity, command.velocity));
  EXPECT_TRUE(sameBits(back.stiffness, command.stiffness));
  EXPECT_TRUE(sameBits(back.damping, command.damping));
}

TEST(Convert, ATruthFrameKeepsEveryBit) {
  TruthFrame truth;
  int i = 2;
  fill(truth.state, i);
  fill(truth.joint_angle, i);
  fill(truth.joint_velocity, i);
  fill(truth.motor_angle, i);
  fill(truth.joint_torque, i);
  fill(truth.p_WE, i);
  fill(truth.quat_WE, i);
  fill(truth.external_force_W, i);
  fill(truth.contact_force_W, i);
  fill(truth.contact_point_W, i);
  truth.contact_phase = ContactPhase::kSliding;
  truth.door_angle = 0.1;
  truth.door_rate = -0.2;
  truth.time = simTimeFromNs(99);

  ballbot_msgs::truth_frame message{};
  toMessage(truth, 5, message);
  EXPECT_EQ(message.q[kPitch], truth.state[kPitch]);
  EXPECT_EQ(message.nu[kOmegaY], truth.state[kPositionDim + kOmegaY]);
  TruthFrame back;
  ASSERT_TRUE(fromMessage(overTheWire(message), back));
  EXPECT_EQ(back.time, truth.time);
  EXPECT_TRUE(sameBits(back.state, truth.state));
  EXPECT_TRUE(sameBits(back.joint_angle, truth.joint_angle));
  EXPECT_TRUE(sameBits(back.joint_velocity, truth.joint_velocity));
  EXPECT_TRUE(sameBits(back.motor_angle, truth.motor_angle));
  EXPECT_TRUE(sameBits(back.joint_torque, truth.joint_torque));
  EXPECT_TRUE(sameBits(back.p_WE, truth.p_WE));
  EXPECT_TRUE(sameBits(back.quat_WE, truth.quat_WE));
  EXPECT_TRUE(sameBits(back.external_force_W, truth.external_force_W));
  EXPECT_TRUE(sameBits(back.contact_force_W, truth.contact_force_W));
  EXPECT_TRUE(sameBits(back.contact_point_W, truth.contact_point_W));
  EXPECT_EQ(back.contact_phase, truth.contact_phase);
  EXPECT_EQ(back.door_angle, truth.door_angle);
  EXPECT_EQ(back.door_rate, truth.door_rate);
}

TEST(Convert, AnEstimateKeepsEveryBit) {
  EstimateFrame estimate;
  int i = 3;
  estimate.time = simTimeFromNs(2'500'000);
  fill(estimate.state, i);
  fill(estimate.sigma, i);
  fill(estimate.contact_force_W, i);
  estimate.aligned = true;
  ballbot_msgs::state_estimate message{};
  toMessage(estimate, 9, message);
  EXPECT_EQ(message.tick, 9);
  EstimateFrame back;
  ASSERT_TRUE(fromMessage(overTheWire(message), back));
  EXPECT_EQ(back.time, estimate.time);
  EXPECT_TRUE(back.aligned);
  EXPECT_TRUE(sameBits(back.state, estimate.state));
  EXPECT_TRUE(sameBits(back.sigma, estimate.sigma));
  EXPECT_TRUE(sameBits(back.contact_force_W, estimate.contact_force_W));
}

TEST(Convert, APlanKeepsEveryBit) {
  PlanFrame plan;
  int i = 1;
  plan.time = simTimeFromNs(14'000'000);
  plan.acts_from = simTimeFromNs(28'000'001);
  plan.accepted = true;
  plan.iterations = 3;
  plan.contact_state = 2;
  plan.status = 5;
  plan.cost = awkward(i++);
  plan.regularisation = awkward(i++);
  fill(plan.contact_asked_W, i);
  fill(plan.contact_counted_on_W, i);
  for (double& term : plan.cost_terms) term = awkward(i++);
  ballbot_msgs::plan_report message{};
  toMessage(plan, 11, message);
  PlanFrame back;
  ASSERT_TRUE(fromMessage(overTheWire(message), back));
  EXPECT_EQ(back.time, plan.time);
  EXPECT_EQ(back.acts_from, plan.acts_from);
  EXPECT_TRUE(back.accepted);
  EXPECT_FALSE(back.fallback);
  EXPECT_EQ(back.iterations, 3);
  EXPECT_EQ(back.contact_state, 2);
  EXPECT_EQ(back.status, 5);
  EXPECT_EQ(back.cost, plan.cost);
  EXPECT_EQ(back.regularisation, plan.regularisation);
  EXPECT_TRUE(sameBits(back.contact_asked_W, plan.contact_asked_W));
  EXPECT_TRUE(sameBits(back.contact_counted_on_W, plan.contact_counted_on_W));
  EXPECT_EQ(std::memcmp(back.cost_terms.data(), plan.cost_terms.data(), sizeof plan.cost_terms), 0);
}

TEST(Convert, AFrameOfAnotherRobotIsRefused) {
  ballbot_msgs::sensor_frame message{};
  toMessage(SensorFrame(), 1, message);
  SensorFrame back;
  ASSERT_TRUE(fromMessage(message, back));
  message.joints = kJointCount + 1;
  for (auto* values : {&message.motor_angle, &message.joint_angle, &message.joint_velocity,
                       &message.joint_torque}) {
    values->push_back(0);
  }
  EXPECT_FALSE(fromMessage(message, back));

  ballbot_msgs::truth_frame truth{};
  toMessage(TruthFrame(), 1, truth);
  truth.coordinates = kPositionDim - 1;
  truth.q.pop_back();
  truth.nu.pop_back();
  TruthFrame true_back;
  EXPECT_FALSE(fromMessage(truth, true_back));
}

}  // namespace
}  // namespace ballbot
