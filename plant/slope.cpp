#include "plant/slope.hpp"

#include <cmath>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {

void Slope::describe(ConfigVisitor& v) {
  v.number(may("slope_deg",
               "angle of the floor against the horizontal; the world's axes are the "
               "floor's"),
           angle, {-20, 20}, kRadPerDeg);
  v.number(may("slope_heading_deg", "direction in which a sloping floor falls, from x"), heading,
           {-180, 180}, kRadPerDeg);
}

Vector3 Slope::gravityInWorld(double gravity) const {
  const double along = std::sin(angle);
  return gravity * Vector3(along * std::cos(heading), along * std::sin(heading), -std::cos(angle));
}

SlopeForces::SlopeForces(const RobotParameters& robot, const Slope& slope)
    : acts_(slope.angle != 0) {
  const Vector3 change = slope.gravityInWorld(robot.gravity) + robot.gravity * Vector3::UnitZ();
  const auto force = [&](int body, double mass, const Vector3& p) {
    forces_[static_cast<std::size_t>(body)] = {static_cast<BodyIndex>(body), p, mass * change};
  };
  const BodyInertia base = robot.baseWithWheels(), last = robot.lastLinkWithPayload();
  force(kBallBody, robot.ball.mass, Vector3::Zero());
  force(kBaseBody, base.mass, base.p_LLcm_L);
  for (int j = 0; j < kArmJointCount; ++j) {
    const BodyInertia& link = j == kArmJointCount - 1 ? last : robot.arm[j].inertia;
    force(kLink1Body + j, link.mass, link.p_LLcm_L);
  }
}

void SlopeForces::addTo(std::vector<PointForce>& forces) const {
  forces.insert(forces.end(), forces_.begin(), forces_.end());
}

double SlopeForces::energy(const Multibody& multibody) const {
  if (!acts_) return 0;
  double energy = 0;
  for (const PointForce& f : forces_) {
    const BodyMotion body = multibody.body(f.body);
    energy -= f.force_W.dot(body.p_WL + body.R_WL * f.p_BP_B);
  }
  return energy;
}

}  // namespace ballbot
