#include "experiment/motion_metrics.hpp"

#include "core/config_reader.hpp"
#include "experiment/believed_robot.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

RobotLimits limitsOf(const RobotParameters& robot, const std::optional<MpcConfig>& mpc) {
  const Constraints c = mpc ? mpc->constraints : Constraints(robot);
  return {robot.wheel_torque_limit, robot.arm_torque_limit, c.arm_lower, c.arm_upper, c.arm_rate_limit, c.tilt_limit};
}

}  // namespace

PlaceReference placeReference(const TaskSchedule& schedule, double t) {
  Tasks tasks;
  schedule.at(t, t, tasks);
  PlaceReference place;
  place.ball = tasks.ball_position;
  place.ee = tasks.p_WE;
  place.ball_asked = (tasks.ball_position_weight.array() > 0).cast<double>();
  place.ee_asked = (tasks.ee_position_weight.array() > 0).cast<double>();
  return place;
}

std::optional<MpcConfig> readMpc(const Scenario& scenario) {
  ConfigReader in(scenario.section("controller"), "controller");
  if (in.text("kind") == "lqr") return std::nullopt;
  ConfigReader mpc = in.child("mpc");
  return MpcConfig::read(mpc, believedRobot(scenario));
}

MotionMetrics::MotionMetrics(const Scenario& scenario)
    : mpc_(readMpc(scenario)),
      tracking_(scenario.release),
      margins_(limitsOf(believedRobot(scenario), mpc_), scenario.release) {}

PlaceReference MotionMetrics::place(SimTime t) const {
  return mpc_ ? placeReference(*mpc_->schedule, toSeconds(t)) : PlaceReference();
}

void MotionMetrics::add(const TruthFrame& truth, const ActuatorCommand& command) {
  margins_.add(truth, command);
  tracking_.add(truth, place(truth.time));
}

std::map<std::string, double> MotionMetrics::values() const {
  std::map<std::string, double> m = tracking_.values();
  for (const auto& value : margins_.values()) m.insert(value);
  return m;
}

std::vector<std::string> MotionMetrics::names() {
  std::vector<std::string> names = TrackingMetrics::names();
  for (const std::string& name : LimitMargins::names()) names.push_back(name);
  return names;
}

}  // namespace ballbot
