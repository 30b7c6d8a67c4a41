#include "plant/door.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kRightAngle = 90 * kRadPerDeg;

double direction(const DoorParameters& p) { return p.counterclockwise ? 1 : -1; }

/// How far the leaf is pressed into a stop: negative in the frame, positive in the buffer [rad].
double beyondStops(const DoorParameters& p, double angle) {
  return std::min(angle, 0.0) + std::max(angle - p.opening_limit, 0.0);
}

/// Stops push and never pull.
double stopTorque(const DoorParameters& p, const DoorMotion& m) {
  const double beyond = beyondStops(p, m.angle);
  if (beyond == 0) return 0;
  const double torque = -p.stop_stiffness * beyond - p.stop_damping * m.rate;
  return beyond < 0 ? std::max(0.0, torque) : std::min(0.0, torque);
}

}  // namespace

void DoorParameters::describe(ConfigVisitor& v) {
  v.vector(must("hinge_m", "x and y of the hinge's axis, through which the front passes"), hinge,
           {-100, 100});
  v.number(must("closed_heading_deg", "direction of the closed leaf, seen from the hinge"),
           closed_heading, {-360, 360}, kRadPerDeg);
  v.choice(must("opens", "way it turns as it opens, away from its front; seen from above"),
           counterclockwise, {{"counterclockwise", true}, {"clockwise", false}});
  v.number(may("width_m", "of the leaf"), width, {0.1, 10});
  v.number(may("height_m", "of the leaf"), height, {0.1, 10});
  v.number(may("thickness_m", "of the leaf"), thickness, {1e-3, 1});
  v.number(must("inertia_kgm2", "of the leaf about the hinge"), inertia, {1e-3, 1e4});
  v.number(may("damping_Nms_per_rad", "viscous friction of the hinge"), damping, {0, 1e4});
  v.number(may("friction_Nm", "dry friction of the hinge"), friction, {0, 1e3});
  v.number(may("friction_smoothing_rad_per_s",
               "rate at which three quarters of the dry friction are reached"),
           friction_smoothing, {1e-4, 10});
  v.number(may("closer_torque_Nm", "of the closer towards closed, at closed"), closer_torque,
           {0, 1e3});
  v.number(may("closer_stiffness_Nm_per_rad", "what the closer adds to its torque as it opens"),
           closer_stiffness, {0, 1e3});
  v.number(may("opening_limit_deg", "angle at which the buffer stops the door"), opening_limit,
           {1, 300}, kRadPerDeg);
}

DoorMotion doorAtRest(const DoorParameters& p) { return {-p.closer_torque / p.stop_stiffness, 0}; }

Face doorFace(const DoorParameters& p, const DoorMotion& m) {
  const double sign = direction(p);
  Face face;
  face.p_WF << p.hinge, 0;
  face.R_WF = faceAxes(p.closed_heading + sign * (m.angle - kRightAngle));
  face.rate = sign * m.rate;
  face.x_low = p.counterclockwise ? 0 : -p.width;
  face.x_high = p.counterclockwise ? p.width : 0;
  face.height = p.height;
  return face;
}

double openingTorque(const DoorParameters& p, const Vector3& point_W, const Vector3& force_W) {
  const Eigen::Vector2d arm = point_W.head<2>() - p.hinge;
  return direction(p) * (arm.x() * force_W.y() - arm.y() * force_W.x());
}

double doorAcceleration(const DoorParameters& p, const DoorMotion& m, double torque) {
  const double friction = p.friction * std::tanh(m.rate / p.friction_smoothing);
  // Inside the frame the closer is the preload against it, so its spring acts from closed on.
  const double closer = p.closer_torque + p.closer_stiffness * std::max(0.0, m.angle);
  return (torque - p.damping * m.rate - friction - closer + stopTorque(p, m)) / p.inertia;
}

double doorEnergy(const DoorParameters& p, const DoorMotion& m) {
  const double open = std::max(0.0, m.angle), beyond = beyondStops(p, m.angle);
  return 0.5 * p.inertia * m.rate * m.rate + p.closer_torque * m.angle +
         0.5 * p.closer_stiffness * open * open + 0.5 * p.stop_stiffness * beyond * beyond;
}

}  // namespace ballbot
