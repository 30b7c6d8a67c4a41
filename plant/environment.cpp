#include "plant/environment.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

BodyIndex bodyByName(ConfigReader& in, const RobotParameters& robot) {
  const std::string name = in.text("body");
  std::vector<std::string> names{"ball", "base"};
  for (const ArmLink& link : robot.arm) names.push_back(link.name);
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) {
    throw InputError(
        fmt::format("{} is '{}', must be one of: {}", in.at("body"), name, fmt::join(names, ", ")));
  }
  return static_cast<BodyIndex>(it - names.begin());
}

Vector3 vector3(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::vector<Push> readPushes(ConfigReader& environment, const RobotParameters& robot) {
  std::vector<Push> pushes;
  for (ConfigReader& in : environment.list("pushes")) {
    Push p;
    p.body = bodyByName(in, robot);
    p.p_BP_B = vector3(in.numbersOr<3>("point_m", {0, 0, 0}, {-10, 10}));
    p.force_W = vector3(in.numbers<3>("force_N", {-1e4, 1e4}));
    p.start = kSimStart + in.duration("start_s", {0, 1e6});
    p.duration = in.duration("duration_s", {kTiny, 1e6});
    in.finish();
    pushes.push_back(p);
  }
  return pushes;
}

std::vector<Push> scheduledPushes(const ConfigNode& scenario) {
  const ConfigNode* environment = scenario.find("environment");
  if (!environment) return {};
  ConfigReader in(scenario);
  ConfigReader robot_in = in.child("robot");
  ConfigReader environment_in = in.child("environment");
  return readPushes(environment_in, readRobot(robot_in));
}

SimTime Environment::nextChange(SimTime now) const {
  SimTime next = SimTime::max();
  for (const Push& p : pushes_) {
    if (p.start > now) next = std::min(next, p.start);
    if (p.end() > now) next = std::min(next, p.end());
  }
  return next;
}

void Environment::addForces(SimTime now, std::vector<PointForce>& forces) const {
  for (const Push& p : pushes_) {
    if (p.activeAt(now)) forces.push_back({p.body, p.p_BP_B, p.force_W});
  }
}

Vector3 Environment::totalForce(SimTime now) const {
  Vector3 sum = Vector3::Zero();
  for (const Push& p : pushes_) {
    if (p.activeAt(now)) sum += p.force_W;
  }
  return sum;
}

}  // namespace ballbot
