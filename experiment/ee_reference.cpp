#include "experiment/ee_reference.hpp"

#include "experiment/motion_metrics.hpp"
#include "experiment/scenario_frame.hpp"

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

bool EeReference::moves() const {
  return schedule && (schedule->ee_position.moves() || schedule->ee_orientation.moves());
}

std::vector<EeStep> EeReference::steps() const {
  std::vector<EeStep> out;
  if (!schedule) return out;
  addSteps(schedule->ee_position, 0, out);
  addSteps(schedule->ee_orientation, 3, out);
  return out;
}

PoseVector EeReference::at(SimTime t) const {
  PoseVector pose = PoseVector::Zero();
  if (!schedule) return pose;
  pose.head<3>() = schedule->ee_position.value(toSeconds(t));
  pose.tail<3>() = schedule->ee_orientation.value(toSeconds(t));
  return pose;
}

EeReference readEeReference(const Scenario& scenario) {
  EeReference out;
  out.home = homeFrame(scenario);
  if (const auto mpc = readMpc(scenario)) out.schedule = mpc->schedule;
  return out;
}

}  // namespace ballbot
