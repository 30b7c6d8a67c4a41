#include "estimator/contact_force_observer.hpp"

#include <Eigen/Dense>

#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr double kDifference_s = 1e-4;  // along the motion, for dM/dt nu
// Directions in which the arm moves E by less than this per rad are not resolved [m].
constexpr double kSingularLever = 0.02;

}  // namespace

ContactForceObserver::ContactForceObserver(const RobotParameters& robot, double bandwidth)
    : dynamics_(robot), bandwidth_(bandwidth) {}

VelocityVector ContactForceObserver::momentum(const PositionVector& q,
                                              const VelocityVector& nu) const {
  return dynamics_.massMatrix(q) * nu;
}

void ContactForceObserver::update(SimTime now, const StateVector& x,
                                  const JointVector& torque) noexcept {
  if (!x.allFinite() || !torque.allFinite()) return;
  const PositionVector q = x.head<kPositionDim>();
  const VelocityVector nu = x.tail<kVelocityDim>();
  const PositionVector dq = kDifference_s * positionRate(q, nu);
  const VelocityVector mass_rate =
      (momentum(q + dq, nu) - momentum(q - dq, nu)) / (2 * kDifference_s);
  const VelocityVector rate = dynamics_.selectionMatrix(q).transpose() * torque + mass_rate -
                              dynamics_.nonlinearEffects(q, nu);
  const VelocityVector p = momentum(q, nu);
  if (!started_) {
    explained_ = p;
    residual_.setZero();
    started_ = true;
  } else {
    // Trapezoids for what is known; r by the implicit rule, stable at any step.
    const double dt = toSeconds(now - time_);
    explained_ += 0.5 * dt * (rate + rate_);
    residual_ = bandwidth_ / (1 + bandwidth_ * dt) * (p - explained_);
    explained_ += dt * residual_;
  }
  rate_ = rate;
  time_ = now;

  const Eigen::Matrix<double, 3, kArmJointCount> J =
      dynamics_.endEffectorJacobian(q).topRightCorner<3, kArmJointCount>();
  Matrix3 normal = J * J.transpose();
  normal.diagonal().array() += kSingularLever * kSingularLever;
  force_W_ = normal.ldlt().solve(J * residual_.tail<kArmJointCount>());
}

}  // namespace ballbot
