#include "plant/door.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/config_reader.hpp"

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

DoorParameters DoorParameters::read(ConfigReader& in) {
  DoorParameters p;
  const auto hinge = in.numbers<2>("hinge_m", {-100, 100});
  p.hinge << hinge[0], hinge[1];
  p.closed_heading = kRadPerDeg * in.number("closed_heading_deg", {-360, 360});
  p.counterclockwise = in.choice(
      "opens", {std::pair<const char*, bool>{"counterclockwise", true}, {"clockwise", false}});
  p.width = in.numberOr("width_m", p.width, {0.1, 10});
  p.height = in.numberOr("height_m", p.height, {0.1, 10});
  p.thickness = in.numberOr("thickness_m", p.thickness, {1e-3, 1});
  p.inertia = in.number("inertia_kgm2", {1e-3, 1e4});
  p.damping = in.numberOr("damping_Nms_per_rad", p.damping, {0, 1e4});
  p.friction = in.numberOr("friction_Nm", p.friction, {0, 1e3});
  p.friction_smoothing =
      in.numberOr("friction_smoothing_rad_per_s", p.friction_smoothing, {1e-4, 10});
  p.closer_torque = in.numberOr("closer_torque_Nm", p.closer_torque, {0, 1e3});
  p.closer_stiffness = in.numberOr("closer_stiffness_Nm_per_rad", p.closer_stiffness, {0, 1e3});
  p.opening_limit =
      kRadPerDeg * in.numberOr("opening_limit_deg", p.opening_limit / kRadPerDeg, {1, 300});
  in.finish();
  return p;
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
