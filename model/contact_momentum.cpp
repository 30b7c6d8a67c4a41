#include "model/contact_momentum.hpp"

#include "model/frames.hpp"

namespace ballbot {

ContactMomentum contactMomentum(const ReducedDynamics& dynamics, const StateVector& x) {
  const PositionVector q = x.head<kPositionDim>();
  const double r = dynamics.robot().ball.radius;
  const Matrix3 R_WB = rotationFromYawPitchRoll(q[kYaw], q[kPitch], q[kRoll]);
  Eigen::Matrix<double, kVelocityDim, 2> N = Eigen::Matrix<double, kVelocityDim, 2>::Zero();
  // Turning about x moves the ball centre, r above P, along -y; about y along x.
  N(kBallVy, 0) = -r;
  N(kBallVx, 1) = r;
  N.middleRows<3>(kOmegaX) = R_WB.topRows<2>().transpose();

  ContactMomentum out;
  out.momentum_W = N.transpose() * (dynamics.massMatrix(q) * x.tail<kVelocityDim>());
  StateVector at_rest = x;
  at_rest.tail<kVelocityDim>().setZero();
  out.gravity_moment_W =
      -N.transpose() * dynamics.nonlinearEffects(q, at_rest.tail<kVelocityDim>());
  out.height_moment = dynamics.energy(at_rest) / dynamics.robot().gravity;
  return out;
}

}  // namespace ballbot
