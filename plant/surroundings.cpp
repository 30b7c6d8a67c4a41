#include "plant/surroundings.hpp"

#include <algorithm>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr int kAngle = 0, kRate = 1, kDoorStretch = 2;

using StretchMap = Eigen::Map<Eigen::Vector2d>;
using ConstStretchMap = Eigen::Map<const Eigen::Vector2d>;

}  // namespace

void WallParameters::describe(ConfigVisitor& v) {
  v.numbers(must("foot_m", "x and y of the middle of its foot"), p_WF.data(), 2, {-100, 100});
  v.number(must("facing_deg", "where its front looks, about the vertical"), heading, {-360, 360},
           kRadPerDeg);
  v.number(may("width_m", "of the wall"), width, {0.01, 100});
  v.number(may("height_m", "of the wall"), height, {0.01, 100});
}

Face wallFace(const WallParameters& p) {
  Face face;
  face.p_WF = p.p_WF;
  face.R_WF = faceAxes(p.heading);
  face.x_low = -0.5 * p.width;
  face.x_high = 0.5 * p.width;
  face.height = p.height;
  return face;
}

void SurroundingsParameters::describe(ConfigVisitor& v) {
  v.section(may("contact", "of the end-effector with wall and door"),
            [&](ConfigVisitor& in) { contact.describe(in); });
  v.section(may("wall", "stands still, and can be touched from its front"),
            [&](ConfigVisitor& in) { wall.emplace().describe(in); });
  v.section(may("door", "on a vertical hinge, and can be touched from its front"),
            [&](ConfigVisitor& in) { door.emplace().describe(in); });
}

void Surroundings::place(double* s) const {
  std::fill_n(s, stateDim(), 0.0);
  if (p_.door) s[kAngle] = doorAtRest(*p_.door).angle;
}

DoorMotion Surroundings::door(const double* s) const {
  return p_.door ? DoorMotion{s[kAngle], s[kRate]} : DoorMotion{};
}

Touch Surroundings::touchDoor(const double* s, const Point& e) const {
  return touch(p_.contact, doorFace(*p_.door, door(s)), e.p_W, e.v_W,
               ConstStretchMap(s + kDoorStretch));
}

Touch Surroundings::touchWall(const double* s, const Point& e) const {
  return touch(p_.contact, wallFace(*p_.wall), e.p_W, e.v_W, ConstStretchMap(s + wallState()));
}

Vector3 Surroundings::derivative(const double* s, const Point& e, double* sdot) const {
  Vector3 force = Vector3::Zero();
  if (p_.door) {
    const Touch t = touchDoor(s, e);
    force += t.force_W;
    sdot[kAngle] = s[kRate];
    sdot[kRate] = doorAcceleration(*p_.door, door(s), openingTorque(*p_.door, e.p_W, -t.force_W));
    StretchMap(sdot + kDoorStretch) = t.slip;
  }
  if (p_.wall) {
    const Touch t = touchWall(s, e);
    force += t.force_W;
    StretchMap(sdot + wallState()) = t.slip;
  }
  return force;
}

void Surroundings::settle(const Point& e, double* s) const {
  if (p_.door) {
    const Touch t = touchDoor(s, e);
    StretchMap(s + kDoorStretch) = t.limit;
  }
  if (p_.wall) {
    const Touch t = touchWall(s, e);
    StretchMap(s + wallState()) = t.limit;
  }
}

Touch Surroundings::observe(const double* s, const Point& e) const {
  Touch sum;
  sum.foot_W = e.p_W;
  for (const bool at_door : {true, false}) {
    if (at_door ? !p_.door : !p_.wall) continue;
    const Touch t = at_door ? touchDoor(s, e) : touchWall(s, e);
    if (t.phase == ContactPhase::kNone) continue;
    sum.phase = std::max(sum.phase, t.phase);
    sum.foot_W = t.foot_W;
    sum.force_W += t.force_W;
    sum.stored += t.stored;
  }
  return sum;
}

double Surroundings::energy(const double* s, const Point& e) const {
  return observe(s, e).stored + (p_.door ? doorEnergy(*p_.door, door(s)) : 0);
}

}  // namespace ballbot
