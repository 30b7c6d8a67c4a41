#include "plant/surroundings.hpp"

#include <algorithm>

#include "core/angle.hpp"
#include "core/config_reader.hpp"

namespace ballbot {
namespace {

constexpr int kAngle = 0, kRate = 1, kDoorStretch = 2;

using StretchMap = Eigen::Map<Eigen::Vector2d>;
using ConstStretchMap = Eigen::Map<const Eigen::Vector2d>;

}  // namespace

WallParameters WallParameters::read(ConfigReader& in) {
  WallParameters p;
  const auto foot = in.numbers<2>("foot_m", {-100, 100});
  p.p_WF << foot[0], foot[1], 0;
  p.heading = kRadPerDeg * in.number("facing_deg", {-360, 360});
  p.width = in.numberOr("width_m", p.width, {0.01, 100});
  p.height = in.numberOr("height_m", p.height, {0.01, 100});
  in.finish();
  return p;
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

SurroundingsParameters SurroundingsParameters::read(ConfigReader& environment) {
  SurroundingsParameters p;
  if (environment.has("contact")) {
    ConfigReader in = environment.child("contact");
    p.contact = ContactParameters::read(in);
  }
  if (environment.has("wall")) {
    ConfigReader in = environment.child("wall");
    p.wall = WallParameters::read(in);
  }
  if (environment.has("door")) {
    ConfigReader in = environment.child("door");
    p.door = DoorParameters::read(in);
  }
  return p;
}

SurroundingsParameters surroundingsOf(const ConfigNode& scenario) {
  const ConfigNode* environment = scenario.find("environment");
  if (!environment) return {};
  ConfigReader in(*environment, "environment");
  return SurroundingsParameters::read(in);
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
