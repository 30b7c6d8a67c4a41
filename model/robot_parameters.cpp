#include "model/robot_parameters.hpp"

#include <cmath>

namespace ballbot {
namespace {

static_assert(kWheelCount == 3 && kArmJointCount >= 2 && kArmJointCount <= kMaxArmJoints,
              "BALLBOT_ARM_JOINTS must be 2 to 7");

/// Inertia of a point of unit mass at p, about the origin.
Matrix3 pointInertia(const Vector3& p) {
  return p.squaredNorm() * Matrix3::Identity() - p * p.transpose();
}

}  // namespace

BodyInertia composed(const BodyInertia& a, const BodyInertia& b, const Vector3& p_AB_A) {
  BodyInertia out;
  out.mass = a.mass + b.mass;
  if (out.mass == 0) return out;
  const Vector3 p_ABcm = p_AB_A + b.p_LLcm_L;
  out.p_LLcm_L = (a.mass * a.p_LLcm_L + b.mass * p_ABcm) / out.mass;
  out.I_LLcm_L = a.I_LLcm_L + a.mass * pointInertia(a.p_LLcm_L - out.p_LLcm_L) +  //
                 b.I_LLcm_L + b.mass * pointInertia(p_ABcm - out.p_LLcm_L);
  return out;
}

Vector3 RobotParameters::contactDirection(int i) const {
  const double s = std::sin(wheels.contact_zenith), c = std::cos(wheels.contact_zenith);
  return {s * std::cos(wheels.azimuth[i]), s * std::sin(wheels.azimuth[i]), c};
}

Vector3 RobotParameters::wheelAxle(int i) const {
  const double s = std::sin(wheels.contact_zenith), c = std::cos(wheels.contact_zenith);
  return {c * std::cos(wheels.azimuth[i]), c * std::sin(wheels.azimuth[i]), -s};
}

Vector3 RobotParameters::wheelCentre(int i) const {
  return (ball.radius + wheels.radius) * contactDirection(i);
}

BodyInertia RobotParameters::baseWithWheels() const {
  BodyInertia total = base;
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 d = wheelAxle(i);
    BodyInertia wheel;
    wheel.mass = wheels.mass;
    wheel.I_LLcm_L = wheels.transverse_inertia * (Matrix3::Identity() - d * d.transpose());
    total = composed(total, wheel, wheelCentre(i));
  }
  return total;
}

BodyInertia RobotParameters::lastLinkWithPayload() const {
  BodyInertia payload;
  payload.mass = payload_mass;
  return composed(arm.back().inertia, payload, p_A3E);
}

double RobotParameters::totalMass() const {
  double sum = ball.mass + base.mass + kWheelCount * wheels.mass + payload_mass;
  for (const ArmLink& link : arm) sum += link.inertia.mass;
  return sum;
}

}  // namespace ballbot
