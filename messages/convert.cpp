#include "messages/convert.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "messages/frame_fields.hpp"
#include "model/signal_table.hpp"

namespace ballbot {
namespace {

/// Of the signals that share the message's field with `first`, all that are in it.
template <typename Frame>
std::size_t sizeOfField(const std::vector<Signal<Frame>>& signals, const Signal<Frame>& first) {
  std::size_t size = 0;
  for (const Signal<Frame>* s = &first; s != signals.data() + signals.size(); ++s) {
    if (std::strcmp(s->message_field, first.message_field) != 0) break;
    size += static_cast<std::size_t>(s->size);
  }
  return size;
}

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
  void operator()(std::vector<double>& field) {
    field.resize(sizeOfField(signalsOf(frame_), *next_));
    for (std::size_t i = 0; i < field.size(); ++next_) {
      const auto size = static_cast<std::size_t>(next_->size);
      std::copy_n(next_->reals(frame_), size, field.begin() + static_cast<std::ptrdiff_t>(i));
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
  void operator()(const std::vector<double>& field) {
    fits_ = fits_ && field.size() == sizeOfField(signalsOf(frame_), *next_);
    if (!fits_) return;
    for (std::size_t i = 0; i < field.size(); ++next_) {
      const auto size = static_cast<std::size_t>(next_->size);
      std::copy_n(field.begin() + static_cast<std::ptrdiff_t>(i), size, next_->reals_of(frame_));
      i += size;
    }
  }
  void operator()(const double& field) {
    if (fits_) *next_++->reals_of(frame_) = field;
  }
  template <typename Integer>
  void operator()(const Integer& field) {
    if (fits_) next_++->set_whole(frame_, field);
  }

  /// All fields had the sizes of the frame. What follows one that had not is not written.
  bool fits() const { return fits_; }

 private:
  Frame& frame_;
  const Signal<Frame>* next_;
  bool fits_ = true;
};

template <typename Frame, typename Message>
void fill(const Frame& frame, std::int64_t tick, SimTime time, Message& out) {
  out.checksum = 0;
  out.tick = tick;
  out.sim_time_ns = toNs(time);
  FieldSizes<Message>::setCounts(out, kJointCount, kPositionDim);
  visitFields(out, Filler<Frame>(frame));
}

template <typename Frame, typename Message>
bool drain(const Message& message, Frame& out) {
  // Fields are visited as ones that may be written; a Drainer takes each as const.
  Drainer<Frame> drainer(out);
  visitFields(const_cast<Message&>(message), drainer);
  return drainer.fits();
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

bool fromMessage(const ballbot_msgs::sensor_frame& message, SensorFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  return drain(message, out);
}
bool fromMessage(const ballbot_msgs::truth_frame& message, TruthFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  return drain(message, out);
}
bool fromMessage(const ballbot_msgs::state_estimate& message, EstimateFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  return drain(message, out);
}
bool fromMessage(const ballbot_msgs::plan_report& message, PlanFrame& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  return drain(message, out);
}
bool fromMessage(const ballbot_msgs::actuator_command& message, ActuatorCommand& out) {
  return drain(message, out);
}

}  // namespace ballbot
