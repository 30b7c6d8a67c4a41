#pragma once

#include <string>
#include <vector>

#include "core/time.hpp"
#include "model/robot_parameters.hpp"
#include "plant/multibody.hpp"

namespace ballbot {

class ConfigNode;
class ConfigReader;
class ConfigVisitor;

/// A force on a point of a body, constant in W from `start` for `duration`.
struct Push {
  BodyIndex body = kBaseBody;
  Vector3 p_BP_B = Vector3::Zero();   ///< point from the body's origin, in its axes [m]
  Vector3 force_W = Vector3::Zero();  ///< [N]
  SimTime start{};
  SimDuration duration{};

  /// @param robot  whose arm's links `body` may name
  void describe(ConfigVisitor& v, const RobotParameters& robot);

  SimTime end() const { return start + duration; }
  bool activeAt(SimTime t) const { return start <= t && t < end(); }
};

/// `pushes:` of the `environment:` section; those read are appended.
void describePushes(ConfigVisitor& v, std::vector<Push>& pushes, const RobotParameters& robot);
/// What the world outside does to the robot whatever the robot does. What it can touch, and what
/// touches back, is in plant/surroundings.hpp.
class Environment {
 public:
  explicit Environment(std::vector<Push> pushes) : pushes_(std::move(pushes)) {}

  /// First time after `now` at which a force sets in or ends; SimTime::max() if there is none.
  SimTime nextChange(SimTime now) const;

  /// Forces that act from `now` until the next change; appended.
  void addForces(SimTime now, std::vector<PointForce>& forces) const;
  /// Their sum [N].
  Vector3 totalForce(SimTime now) const;

 private:
  std::vector<Push> pushes_;
};

}  // namespace ballbot
