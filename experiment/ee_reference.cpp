#include "experiment/ee_reference.hpp"

#include "core/config_reader.hpp"
#include "experiment/believed_robot.hpp"
#include "experiment/motion_metrics.hpp"
#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {
namespace {

/// The node at a path of keys, or null.
const ConfigNode* descend(const ConfigNode& root, std::initializer_list<const char*> keys) {
  const ConfigNode* node = &root;
  for (const char* key : keys) {
    node = node->kind() == ConfigNode::Kind::kMap ? node->find(key) : nullptr;
    if (!node) return nullptr;
  }
  return node;
}

/// Adds the steps of one task to components [first, first + 3) of the pose.
void addSteps(const Scenario& scenario, const char* task, int first, EeReference& out) {
  const ConfigNode* node = descend(scenario.tree, {"controller", "mpc", "tasks", task, "reference"});
  if (!node) return;
  ConfigReader in(*node, std::string("controller.mpc.tasks.") + task + ".reference");
  if (in.has("initial")) {
    const auto initial = in.numbers<3>("initial");
    out.initial.segment<3>(first) << initial[0], initial[1], initial[2];
  }
  for (ConfigReader& move : in.list("moves")) {
    if (!move.has("by") || move.numberOr("over_s", 0) > 0) continue;
    const auto by = move.numbers<3>("by");
    EeStep step;
    step.at = kSimStart + durationFromSeconds(move.number("at_s"));
    step.by.segment<3>(first) << by[0], by[1], by[2];
    out.steps.push_back(step);
  }
}

}  // namespace

PoseVector EeReference::at(SimTime t) const {
  PoseVector pose = initial;
  for (const EeStep& step : steps) {
    if (step.at <= t) pose += step.by;
  }
  return pose;
}

EeReference readEeReference(const Scenario& scenario) {
  EeReference out;
  const ConfigNode* kind = descend(scenario.tree, {"controller", "kind"});
  if (!kind || kind->text() == "lqr") return out;
  const ReducedDynamics dynamics(believedRobot(scenario));
  const auto rest = dynamics.endEffector(findEquilibrium(dynamics, dynamics.robot().nominal_arm).x);
  out.initial << rest.p_WE, yawPitchRollFromRotation(rest.R_WE);
  addSteps(scenario, "ee_position", 0, out);
  addSteps(scenario, "ee_orientation", 3, out);
  return out;
}

}  // namespace ballbot
