#pragma once

#include <cstdint>

#include "ballbot_msgs/actuator_command.hpp"
#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/truth_frame.hpp"
#include "core/time.hpp"
#include "model/signals.hpp"
#include "model/state.hpp"
#include "model/truth.hpp"

namespace ballbot {

// Messages to and from model types. Every number keeps its bits. The tick is the number of the
// event, 0 inside a step_request or step_reply.

void toMessage(const SensorFrame& frame, std::int64_t tick, ballbot_msgs::sensor_frame& out);
void fromMessage(const ballbot_msgs::sensor_frame& message, SensorFrame& out);

void toMessage(const ActuatorCommand& command, std::int64_t tick, SimTime time,
               ballbot_msgs::actuator_command& out);
void fromMessage(const ballbot_msgs::actuator_command& message, ActuatorCommand& out);

void toMessage(const TruthFrame& truth, std::int64_t tick, ballbot_msgs::truth_frame& out);
void fromMessage(const ballbot_msgs::truth_frame& message, TruthFrame& out);

/// @param x (q, nu) as in model/state.hpp
/// @param sigma one standard deviation of px, py [m], tilt about two axes, yaw [rad], vx, vy [m/s],
///        w_WB_B [rad/s]
/// The tick is filled in by the recorder.
void toMessage(SimTime time, const StateVector& x, const Eigen::Matrix<double, 10, 1>& sigma,
               bool aligned, ballbot_msgs::state_estimate& out);
/// The state (q, nu) of an estimate.
StateVector stateOf(const ballbot_msgs::state_estimate& message);

}  // namespace ballbot
