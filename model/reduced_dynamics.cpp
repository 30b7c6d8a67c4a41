#include "model/reduced_dynamics.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "model/dynamics_lanes.hpp"
#include "model/end_effector.hpp"
#include "model/frames.hpp"
#include "model/inverse_mass.hpp"
#include "model/newton_euler.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {

using Pass = NewtonEuler<double>;

ReducedDynamics::ReducedDynamics(const RobotParameters& robot)
    : robot_(robot), constants_(std::make_shared<DynamicsConstants>(robot)) {}

MassMatrix ReducedDynamics::massMatrix(const PositionVector& q) const {
  return Pass(*constants_, q, VelocityVector::Zero()).massMatrix();
}

VelocityVector ReducedDynamics::nonlinearEffects(const PositionVector& q,
                                                 const VelocityVector& nu) const {
  return Pass(*constants_, q, nu).nonlinearEffects();
}

SelectionMatrix ReducedDynamics::selectionMatrix(const PositionVector& q) const {
  SelectionMatrix S = SelectionMatrix::Zero();
  S.topRows<kWheelCount>() =
      OmniwheelKinematics(robot_).wheelRows(rotationFromYawPitchRoll(q[kYaw], q[kPitch], q[kRoll]));
  S.bottomRightCorner<kArmJointCount, kArmJointCount>().setIdentity();
  return S;
}

VelocityVector ReducedDynamics::acceleration(const PositionVector& q, const VelocityVector& nu,
                                             const JointVector& tau,
                                             const Vector3& lambda_W) const {
  StateVector x;
  x.head<kPositionDim>() = q;
  x.tail<kVelocityDim>() = nu;
  return derivative(x, tau, lambda_W).tail<kVelocityDim>();
}

StateVector ReducedDynamics::derivative(const StateVector& x, const JointVector& tau,
                                        const Vector3& lambda_W, const Vector3* moment_W) const {
  StateVector dx;
  derivatives(1, &x, &tau, &lambda_W, &dx, moment_W);
  return dx;
}

void ReducedDynamics::derivatives(int count, const StateVector* x, const JointVector* tau,
                                  const Vector3* lambda_W, StateVector* dx,
                                  const Vector3* moment_W) const {
  for (int first = 0; first < count; first += Pack::kLanes) {
    const DynamicsLanes<> lanes(*constants_, first, count, x);
    const DynamicsLanes<>::Pass& pass = lanes.pass;
    Eigen::Matrix<Pack, kStateDim, 1> rate;
    rate.head<kPositionDim>() = lanes.nu;
    rate.segment<3>(kYaw) = pass.eulerRates();
    DynamicsLanes<>::Pass::Vec8 force =
        pass.appliedForce(lanes.gathered<0, kJointCount>(tau), lanes.gathered<0, 3>(lambda_W));
    if (moment_W) pass.addMoment(lanes.gathered<0, 3>(moment_W), force);
    rate.tail<kVelocityDim>() = force - pass.nonlinearEffects();
    InverseMass<Pack>(*constants_, pass).multiplyInPlace(rate.tail<kVelocityDim>());
    lanes.put<kStateDim>(rate.data(), dx, [](StateVector& out) { return out.data(); });
  }
}

ReducedDynamics::EndEffector ReducedDynamics::endEffector(const StateVector& x) const {
  const Pass pass(*constants_, x.head<kPositionDim>(), x.tail<kVelocityDim>());
  const EndEffectorKinematics<double> E(*constants_, pass, x.head<2>(), x.segment<2>(kPositionDim));
  return {E.position, E.rotation, E.velocity, E.angular_velocity};
}

EndEffectorJacobian ReducedDynamics::endEffectorJacobian(const PositionVector& q) const {
  StateVector x = StateVector::Zero();
  x.head<kPositionDim>() = q;
  EndEffectorLinearization out;
  linearizeEndEffector(x, out);
  return out.jacobian;
}

double ReducedDynamics::potentialEnergy(const PositionVector& q) const {
  const Pass pass(*constants_, q, VelocityVector::Zero());
  const double height_moment =
      (pass.R_WB * pass.composite[0].first).z() + constants_->total_mass * constants_->ball_radius;
  return constants_->gravity * height_moment;
}

double ReducedDynamics::energy(const StateVector& x) const {
  const VelocityVector nu = x.tail<kVelocityDim>();
  const Pass pass(*constants_, x.head<kPositionDim>(), nu);
  const double height_moment =
      (pass.R_WB * pass.composite[0].first).z() + constants_->total_mass * constants_->ball_radius;
  return 0.5 * nu.dot(pass.massMatrix() * nu) + constants_->gravity * height_moment;
}

Equilibrium findEquilibrium(const ReducedDynamics& dynamics, const ArmVector& arm) {
  Equilibrium found;
  found.x.setZero();
  found.x.segment<kArmJointCount>(kArm1) = arm;
  // The rows of h at rest that belong to w_WB_B are first moment x gravity, in B: zero exactly when
  // the centre of mass is above K. With yaw = 0 that gives pitch and roll in closed form.
  const DynamicsConstants constants(dynamics.robot());
  const Pass pass(constants, found.x.head<kPositionDim>(), VelocityVector::Zero());
  const Vector3 up = pass.composite[0].first.normalized();
  const double limit = 30 * kRadPerDeg;
  if (!(up.z() >= std::cos(limit))) {
    throw NumericalError(fmt::format(
        "no equilibrium within 30 degrees for the arm at ({:.3f}, {:.3f}, {:.3f}) rad: the centre "
        "of mass is {:.1f} degrees off the axis through the ball",
        arm[0], arm[1], arm[2], std::acos(up.z()) / limit * 30));
  }
  found.x[kPitch] = std::asin(-up.x());
  found.x[kRoll] = std::atan2(up.y(), up.z());
  found.tau.setZero();
  found.tau.tail<kArmJointCount>() =
      dynamics.nonlinearEffects(found.x.head<kPositionDim>(), VelocityVector::Zero())
          .tail<kArmJointCount>();
  return found;
}

}  // namespace ballbot
