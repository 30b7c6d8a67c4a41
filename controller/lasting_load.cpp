#include "controller/lasting_load.hpp"

#include <cmath>

#include <Eigen/LU>

#include "core/angle.hpp"
#include "model/contact_momentum.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr double kMostLean = 20 * kRadPerDeg;
constexpr int kIterations = 8;
constexpr double kStep = 1e-6;  // of the differences [rad]
constexpr double kAtRest_Nm = 1e-11;

/// About x and y of W through the contact, of gravity and force [N m].
Eigen::Vector2d momentAboutContact(const ReducedDynamics& dynamics, const PositionVector& q,
                                   const VelocityVector& force) {
  const Matrix3 R_WB = rotationFromYawPitchRoll(q[kYaw], q[kPitch], q[kRoll]);
  const double r = dynamics.robot().ball.radius;
  const Eigen::Vector2d of_force(-r * force[kBallVy], r * force[kBallVx]);
  return gravityAboutContact(dynamics, q).moment_W + of_force +
         R_WB.topRows<2>() * force.segment<3>(kOmegaX);
}

/// Pitch and roll at which neither gravity nor force turns robot and ball about the contact.
bool lean(const ReducedDynamics& dynamics, const VelocityVector& force, PositionVector& q) {
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector2d moment = momentAboutContact(dynamics, q, force);
    if (moment.cwiseAbs().maxCoeff() < kAtRest_Nm) return true;
    Eigen::Matrix2d by_angle;
    for (int j = 0; j < 2; ++j) {
      PositionVector ahead = q, behind = q;
      ahead[kPitch + j] += kStep;
      behind[kPitch + j] -= kStep;
      by_angle.col(j) = (momentAboutContact(dynamics, ahead, force) -
                         momentAboutContact(dynamics, behind, force)) /
                        (2 * kStep);
    }
    q.segment<2>(kPitch) -= by_angle.inverse() * moment;
    if (!(q.segment<2>(kPitch).cwiseAbs().maxCoeff() < kMostLean)) return false;
  }
  return momentAboutContact(dynamics, q, force).cwiseAbs().maxCoeff() < 1e3 * kAtRest_Nm;
}

/// Of the drives at rest in q under `force`.
JointVector holdingTorque(const ReducedDynamics& dynamics, const PositionVector& q,
                          const VelocityVector& force) {
  const VelocityVector needed = dynamics.nonlinearEffects(q, VelocityVector::Zero()) - force;
  const Matrix3 wheels_on_base =
      dynamics.selectionMatrix(q).block<kWheelCount, 3>(0, kOmegaX).transpose();
  JointVector tau;
  tau.head<kWheelCount>() = wheels_on_base.inverse() * needed.segment<3>(kOmegaX);
  tau.tail<kArmJointCount>() = needed.tail<kArmJointCount>();
  return tau;
}

}  // namespace

bool findLastingLoad(const ReducedDynamics& dynamics, const StateVector& at,
                     const VelocityVector& force, LastingLoad& out) noexcept {
  out = LastingLoad();
  PositionVector q = at.head<kPositionDim>(), without = q;
  if (!q.allFinite() || !force.allFinite()) return false;
  if (!lean(dynamics, VelocityVector::Zero(), without)) return false;
  q.segment<2>(kPitch) = without.segment<2>(kPitch);
  if (!lean(dynamics, force, q)) return false;
  out.x.head<kPositionDim>() = q;
  out.torque = holdingTorque(dynamics, q, force);
  out.shift = out.torque - holdingTorque(dynamics, without, VelocityVector::Zero());
  // What the model does there without the force is what the force undoes.
  out.acceleration = -dynamics.derivative(out.x, out.torque, Vector3::Zero()).tail<kVelocityDim>();
  out.acts = out.acceleration.allFinite() && out.torque.allFinite();
  return out.acts;
}

}  // namespace ballbot
