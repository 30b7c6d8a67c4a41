#include "plant/environment.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config_visitor.hpp"
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

}  // namespace

void Push::describe(ConfigVisitor& v, const RobotParameters& robot) {
  v.other(must("body", "on which the force acts"),
          "ball, base, or a link of the arm by its URDF name",
          [&](ConfigReader& in) { body = bodyByName(in, robot); });
  v.vector(may("point_m", "where it acts, from the body's origin in its axes"), p_BP_B, {-10, 10});
  v.vector(must("force_N", "constant in the world"), force_W, {-1e4, 1e4});
  SimDuration since = start - kSimStart;
  v.duration(must("start_s", "when the force sets in"), since, {0, 1e6});
  start = kSimStart + since;
  v.duration(must("duration_s", "how long the force acts"), duration, {kTiny, 1e6});
}

void describePushes(ConfigVisitor& v, std::vector<Push>& pushes, const RobotParameters& robot) {
  v.list(may("pushes", "forces on points of bodies, each for some time"), [&](ConfigVisitor& in) {
    pushes.emplace_back();
    pushes.back().describe(in, robot);
  });
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
