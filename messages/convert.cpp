#include "messages/convert.hpp"

#include <algorithm>
#include <cstddef>

#include "messages/frame_fields.hpp"
#include "model/signal_table.hpp"

namespace ballbot {
namespace {

/// Fills the fields of a message from the signals of a frame, one after the other.
template <typename Frame>
class Filler {
 public:
  explicit Filler(const Frame& frame) : frame_(frame), next_(signalsOf(frame).data()) {}

  template <std::size_t N>
  void operator()(double (&field)[N]) {
    for (std::size_t i = 0; i < N; ++next_) {
      const auto size = static_cast<std::size_t>(next_->size);
      std::copy_n(next_->reals(frame_), size, field + i);
      i += size;
    }
  }
  void operator()(double& field) { field = *next_++->reals(frame_); }
  template <typename Integer>
  void operator()(Integer& field) {
    field = static_cast<Integer>(next_++->whole(frame_));
  }

 private:
  const Frame& frame_;
  const Signal<Frame>* next_;
};

/// The other way.
template <typename Frame>
class Drainer {
 public:
  explicit Drainer(Frame& frame) : frame_(frame), next_(signalsOf(frame).data()) {}

  template <std::size_t N>
  void operator()(const double (&field)[N]) {
    for (std::size_t i = 0; i < N; ++next_) {
      const auto size = static_cast<std::size_t>(next_->size);
      std::copy_n(field + i, size, next_->reals_of(frame_));
      i += size;
    }
  }
  void operator()(const double& field) { *next_++->reals_of(frame_) = field; }
  template <typename Integer>
  void operator()(const Integer& field) {
    next_++->set_whole(frame_, field);
  }

 private:
  Frame& frame_;
  const Signal<Frame>* next_;
};

template <typename Frame, typename Message>
void fill(const Frame& frame, std::int64_t tick, SimTime time, Message& out) {
  out.checksum = 0;
  out.tick = tick;
  out.sim_time_ns = toNs(time);
  visitFields(out, Filler<Frame>(frame));
}

template <typename Frame, typename Message>
void drain(const Message& message, Frame& out) {
  // Fields are visited as ones that may be written; a Drainer takes each as const.
  visitFields(const_cast<Message&>(message), Drainer<Frame>(out));
}

}  // namespace

void toMessage(const SensorFrame& frame, std::int64_t tick, ballbot_msgs::sensor_frame& out) {
  fill(frame, tick, frame.time, out);
}
void toMessage(const TruthFrame& frame, std::int64_t tick, ballbot_msgs::truth_frame& out) {
  fill(frame, tick, frame.time, out);
}
void toMessage(const EstimateFrame& frame, std::int64_t tick, ballbot_msgs::state_estimate& out) {
  fill(frame, tick, frame.time, out);
}
void toMessage(const PlanFrame& frame, std::int64_t tick, ballbot_msgs::plan_report& out) {
  fill(frame, tick, frame.time, out);
}
void toMessage(const ActuatorCommand& command, std::int64_t tick, SimTime time,
               ballbot_msgs::actuator_command& out) {
  fill(command, tick, time, out);
}

void fromMessage(const ballbot_msgs::sensor_frame& message, SensorFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  drain(message, out);
}
void fromMessage(const ballbot_msgs::truth_frame& message, TruthFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  drain(message, out);
}
void fromMessage(const ballbot_msgs::state_estimate& message, EstimateFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  drain(message, out);
}
void fromMessage(const ballbot_msgs::plan_report& message, PlanFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  drain(message, out);
}
void fromMessage(const ballbot_msgs::actuator_command& message, ActuatorCommand& out) {
  drain(message, out);
}

}  // namespace ballbot
