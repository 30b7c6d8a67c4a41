#pragma once

#include <cstdint>

#include "ballbot_msgs/actuator_command.hpp"
#include "ballbot_msgs/plan_report.hpp"
#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/truth_frame.hpp"
#include "core/time.hpp"
#include "model/reports.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

// Frames to and from their messages, by the tables of model/signal_table.hpp. Every number keeps
// its bits. The tick is the number of the event, 0 inside a step_request or step_reply.

void toMessage(const SensorFrame& frame, std::int64_t tick, ballbot_msgs::sensor_frame& out);
void toMessage(const TruthFrame& frame, std::int64_t tick, ballbot_msgs::truth_frame& out);
void toMessage(const EstimateFrame& frame, std::int64_t tick, ballbot_msgs::state_estimate& out);
void toMessage(const PlanFrame& frame, std::int64_t tick, ballbot_msgs::plan_report& out);
/// A command has no time of its own.
void toMessage(const ActuatorCommand& command, std::int64_t tick, SimTime time,
               ballbot_msgs::actuator_command& out);

// False, with `out` unspecified, if the message is of a robot with more or fewer joints.
[[nodiscard]] bool fromMessage(const ballbot_msgs::sensor_frame& message, SensorFrame& out);
[[nodiscard]] bool fromMessage(const ballbot_msgs::truth_frame& message, TruthFrame& out);
[[nodiscard]] bool fromMessage(const ballbot_msgs::state_estimate& message, EstimateFrame& out);
[[nodiscard]] bool fromMessage(const ballbot_msgs::plan_report& message, PlanFrame& out);
[[nodiscard]] bool fromMessage(const ballbot_msgs::actuator_command& message, ActuatorCommand& out);

}  // namespace ballbot
