#include "model/contact_momentum.hpp"

#include "model/frames.hpp"

namespace ballbot {

namespace {

using RigidTurns = Eigen::Matrix<double, kVelocityDim, 2>;

/// N(q): everything turns about x, or y, of W through P.
RigidTurns rigidTurns(const RobotParameters& robot, const PositionVector& q) {
  const Matrix3 R_WB = rotationFromYawPitchRoll(q[kYaw], q[kPitch], q[kRoll]);
  RigidTurns N = RigidTurns::Zero();
  // Turning about x moves the ball centre, r above P, along -y; about y along x.
  N(kBallVy, 0) = -robot.ball.radius;
  N(kBallVx, 1) = robot.ball.radius;
  N.middleRows<3>(kOmegaX) = R_WB.topRows<2>().transpose();
  return N;
}

}  // namespace

Eigen::Vector2d contactMomentum(const ReducedDynamics& dynamics, const StateVector& x) {
  const PositionVector q = x.head<kPositionDim>();
  return rigidTurns(dynamics.robot(), q).transpose() *
         (dynamics.massMatrix(q) * x.tail<kVelocityDim>());
}

GravityAboutContact gravityAboutContact(const ReducedDynamics& dynamics, const PositionVector& q) {
  const VelocityVector h = dynamics.nonlinearEffects(q, VelocityVector::Zero());
  return {-rigidTurns(dynamics.robot(), q).transpose() * h,
          dynamics.potentialEnergy(q) / dynamics.robot().gravity};
}

}  // namespace ballbot
