#include "model/spinning_dynamics.hpp"

#include "model/dynamics_linearization.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {
namespace {

using Pass = NewtonEuler<double, true>;
using Lanes = DynamicsLanes<true>;

}  // namespace

SpinningDynamics::SpinningDynamics(const RobotParameters& robot)
    : held_(robot), constants_(std::make_shared<const DynamicsConstants>(robot)) {}

SpinningMassMatrix SpinningDynamics::massMatrix(const PositionVector& q) const {
  return Pass(*constants_, q, SpinningVelocityVector::Zero()).massMatrix();
}

SpinningVelocityVector SpinningDynamics::nonlinearEffects(const PositionVector& q,
                                                          const SpinningVelocityVector& nu) const {
  return Pass(*constants_, q, nu).nonlinearEffects();
}

SpinningSelectionMatrix SpinningDynamics::selectionMatrix(const PositionVector& q) const {
  SpinningSelectionMatrix S = SpinningSelectionMatrix::Zero();
  S.leftCols<kVelocityDim>() = held_.selectionMatrix(q);
  const Pass pass(*constants_, q, SpinningVelocityVector::Zero());
  S.col(kBallSpin).head<kWheelCount>() =
      -constants_->ratio * (constants_->axles * pass.R_WB.row(2).transpose());
  return S;
}

SpinningVelocityVector SpinningDynamics::acceleration(const PositionVector& q,
                                                      const SpinningVelocityVector& nu,
                                                      const JointVector& tau,
                                                      const Vector3& lambda_W,
                                                      double floor_torque) const {
  SpinningStateVector x;
  x << q, nu;
  return derivative(x, tau, lambda_W, floor_torque).tail<kSpinningVelocityDim>();
}

SpinningStateVector SpinningDynamics::derivative(const SpinningStateVector& x,
                                                 const JointVector& tau, const Vector3& lambda_W,
                                                 double floor_torque,
                                                 const Vector3* moment_W) const {
  const Pass pass(*constants_, x.head<kPositionDim>(), x.tail<kSpinningVelocityDim>());
  SpinningVelocityVector force = pass.appliedForce(tau, lambda_W);
  if (moment_W) pass.addMoment(*moment_W, force);
  force -= pass.nonlinearEffects();
  force[kBallSpin] += floor_torque;
  InverseMass<double, true>(*constants_, pass).multiplyInPlace(force);
  SpinningStateVector dx;
  dx << x.segment<kVelocityDim>(kPositionDim), force;
  dx.segment<3>(kYaw) = pass.eulerRates();
  return dx;
}

SpinningDynamics::Linearization::Linearization() {
  for (const int i : {+kBallX, +kBallY}) df_dx(i, kPositionDim + i) = 1;
  for (int i = kArm1; i < kPositionDim; ++i) df_dx(i, kPositionDim + i) = 1;
  df_dx(kRoll, kPositionDim + kOmegaX) = 1;
}

void SpinningDynamics::linearize(const SpinningStateVector& x, const JointVector& tau,
                                 const Vector3& lambda_W, double floor_torque, Linearization& out,
                                 const Vector3* moment_W) const {
  const Lanes lanes(*constants_, 0, 1, &x);
  linearizeKinematics(lanes, &out);
  linearizeDynamics(*constants_, lanes, &tau, &lambda_W, moment_W, &floor_torque, &out);
}

double SpinningDynamics::floorSpinTorque(const StateVector& x, const VelocityVector& dnu,
                                         const JointVector& tau) const {
  SpinningVelocityVector nu, rate;
  nu << x.tail<kVelocityDim>(), 0;
  rate << dnu, 0;
  const Pass pass(*constants_, x.head<kPositionDim>(), nu);
  return pass.massMatrix().row(kBallSpin).dot(rate) + pass.nonlinearEffects()[kBallSpin] -
         pass.appliedForce(tau, Vector3::Zero())[kBallSpin];
}

double SpinningDynamics::floorSpinTorque(const StateVector& x, const JointVector& tau,
                                         const Vector3& lambda_W, const Vector3* moment_W) const {
  return floorSpinTorque(x, held_.derivative(x, tau, lambda_W, moment_W).tail<kVelocityDim>(), tau);
}

double SpinningDynamics::energy(const SpinningStateVector& x) const {
  const SpinningVelocityVector nu = x.tail<kSpinningVelocityDim>();
  return 0.5 * nu.dot(massMatrix(x.head<kPositionDim>()) * nu) +
         held_.potentialEnergy(x.head<kPositionDim>());
}

}  // namespace ballbot
