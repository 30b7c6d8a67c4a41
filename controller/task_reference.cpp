#include "controller/task_reference.hpp"

namespace ballbot {
namespace {

/// Adds the steps of one signal as components [first, first + 3) of the pose.
void addSteps(const TimeSignal<3>& signal, int first, std::vector<EeStep>& out) {
  for (const TimeSignal<3>::Step& step : signal.steps()) {
    EeStep pose{kSimStart + durationFromSeconds(step.at), PoseVector::Zero()};
    pose.by.segment<3>(first) = step.by;
    out.push_back(pose);
  }
}

}  // namespace

PlaceReference TaskReference::place(SimTime time) const {
  const double t = toSeconds(time);
  Tasks tasks;
  tasks_->at(t, t, tasks);
  PlaceReference place;
  place.ball = tasks.ball_position;
  place.ee = tasks.p_WE;
  place.ball_asked = (tasks.ball_position_weight.array() > 0).cast<double>();
  place.ee_asked = (tasks.ee_position_weight.array() > 0).cast<double>();
  return place;
}

PoseVector TaskReference::eePose(SimTime t) const {
  PoseVector pose = PoseVector::Zero();
  pose.head<3>() = tasks_->ee_position.value(toSeconds(t));
  pose.tail<3>() = tasks_->ee_orientation.value(toSeconds(t));
  return pose;
}

bool TaskReference::eeMoves() const {
  return tasks_->ee_position.moves() || tasks_->ee_orientation.moves();
}

std::vector<EeStep> TaskReference::eeSteps() const {
  std::vector<EeStep> out;
  addSteps(tasks_->ee_position, 0, out);
  addSteps(tasks_->ee_orientation, 3, out);
  return out;
}

}  // namespace ballbot
