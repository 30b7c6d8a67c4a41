#include "plant/plant_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace ballbot {
namespace {

MultibodyOptions multibodyOptions(const PlantConfig& config) {
  MultibodyOptions o;
  o.structure = config.fidelity.multibody;
  o.rotors = config.fidelity.actuators == ActuatorLevel::kSeriesElastic;
  o.ball_spin = config.fidelity.contact == ContactLevel::kRollingWithSpinFriction;
  for (int i = 0; i < kJointCount; ++i) {
    o.rotor_inertia[i] = config.actuators.of(i).motor_inertia;
    o.gear_ratio[i] = config.actuators.of(i).gear_ratio;
  }
  return o;
}

}  // namespace

PlantDynamics::PlantDynamics(const PlantConfig& config)
    : fidelity_(config.fidelity),
      parameters_(config.actuators),
      spin_friction_(config.spin_friction),
      gravity_(config.robot.gravity),
      p_BI_B_(config.robot.p_BI_B),
      multibody_(makeMultibody(config.robot, multibodyOptions(config))) {
  for (int i = 0; i < kJointCount; ++i) {
    actuators_.units.emplace_back(parameters_.of(i), fidelity_.friction, fidelity_.speed_limit,
                                  fidelity_.actuators == ActuatorLevel::kSeriesElastic);
  }
  loads_.forces.reserve(16);
}

void PlantDynamics::demand(const JointVector& motor_torque, double since_last) {
  for (int i = 0; i < kJointCount; ++i) actuators_.units[i].demand(motor_torque[i], since_last);
}

void PlantDynamics::applyActuators(double since_tick) {
  const JointMotion m = multibody_->joints();
  for (int i = 0; i < kJointCount; ++i) {
    const auto t = actuators_.units[i].torques(
        since_tick, {m.rotor_angle[i], m.rotor_velocity[i], m.angle[i], m.velocity[i]});
    loads_.joint_torque[i] = t.joint;
    loads_.rotor_torque[i] = t.rotor;
  }
}

JointVector PlantDynamics::jointTorque(double since_tick) {
  applyActuators(since_tick);
  return loads_.joint_torque;
}

void PlantDynamics::derivative(double since_tick, const double* y, double* ydot) {
  multibody_->realize(y);
  applyActuators(since_tick);
  const BaseMotion base = multibody_->base();
  BaseAcceleration acceleration;
  if (held_) {
    multibody_->derivativeHeld(loads_, ydot);
  } else {
    loads_.ball_spin_torque =
        -spin_friction_.torque * std::tanh(base.ball_spin / spin_friction_.smoothing);
    multibody_->derivative(loads_, ydot);
    acceleration = multibody_->baseAcceleration(ydot);
  }
  forceIntegral(ydot, dim()) = specificForce(base, acceleration);
  rateIntegral(ydot, dim()) = base.R_WB.transpose() * base.w_WB_W;
}

Vector3 PlantDynamics::specificForce(const BaseMotion& base,
                                     const BaseAcceleration& acceleration) const {
  const Vector3 r = base.R_WB * p_BI_B_;
  const Vector3 a = acceleration.a_WK_W + acceleration.alpha_WB_W.cross(r) +
                    base.w_WB_W.cross(base.w_WB_W.cross(r));
  return base.R_WB.transpose() * (a + gravity_ * Vector3::UnitZ());
}

}  // namespace ballbot
