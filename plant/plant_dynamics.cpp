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
  if (config.fidelity.contact == ContactLevel::kCompliant) {
    o.floor = config.floor;
    o.spin_smoothing = config.spin_friction.smoothing;
  }
  if (config.fidelity.wheels_slip) o.wheel_slip = config.wheel_contact;
  // Long enough for the integration, whatever its step.
  o.slip_fade_s = 2.5 * toSeconds(std::min(config.substep, config.drive_period));
  o.wheel_contacts = config.knowsWheels();
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
      gravity_W_(config.slope.gravityInWorld(config.robot.gravity)),
      weight_(config.robot.gravity * config.robot.totalMass()),
      slope_(config.robot, config.slope),
      p_BI_B_(config.robot.p_BI_B),
      p_A3E_(config.robot.p_A3E),
      surroundings_(config.surroundings),
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

void PlantDynamics::place(const RobotPose& pose, double* y) const {
  multibody_->place(pose, y);
  surroundings_.place(y + multibody_->stateDim());
}

void PlantDynamics::settle(double* y) {
  multibody_->realize(y);
  if (surroundings_.stateDim() > 0) {
    surroundings_.settle(endEffector(), y + multibody_->stateDim());
  }
}

Surroundings::Point PlantDynamics::endEffector() const {
  const BodyMotion link = multibody_->body(kHandBody);
  const Vector3 r = link.R_WL * p_A3E_;
  return {link.p_WL + r, link.v_WL_W + link.w_WL_W.cross(r)};
}

Touch PlantDynamics::touch(const double* y) const {
  return surroundings_.observe(surroundingsState(y), endEffector());
}

double PlantDynamics::energy(const double* y) const {
  return multibody_->energy() + slope_.energy(*multibody_) +
         surroundings_.energy(surroundingsState(y), endEffector());
}

BallOnFloor PlantDynamics::ballOnFloor() const {
  const BaseMotion base = multibody_->base();
  BallOnFloor out;
  out.spin_rate = base.ball_spin;
  out.held = spin_friction_.heldAt(base.p_WK.head<2>());
  if (fidelity_.contact == ContactLevel::kCompliant) {
    out.held *= multibody_->floorLoad(0).force.z() / weight_;
  }
  out.torque = -out.held * std::tanh(base.ball_spin / spin_friction_.smoothing);
  return out;
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
  const std::size_t pushes = loads_.forces.size();
  if (slope_.acts()) slope_.addTo(loads_.forces);
  if (surroundings_.stateDim() > 0) {
    const Vector3 force = surroundings_.derivative(surroundingsState(y), endEffector(),
                                                   ydot + multibody_->stateDim());
    loads_.forces.push_back({kHandBody, p_A3E_, force});
  }
  if (held_) {
    multibody_->derivativeHeld(loads_, ydot);
  } else {
    const double held = spin_friction_.heldAt(base.p_WK.head<2>());
    loads_.ball_spin_torque = -held * std::tanh(base.ball_spin / spin_friction_.smoothing);
    loads_.spin_lever = held / weight_;
    multibody_->derivative(loads_, ydot);
    acceleration = multibody_->baseAcceleration(ydot);
  }
  loads_.forces.resize(pushes);
  forceIntegral(ydot, dim()) = specificForce(base, acceleration);
  rateIntegral(ydot, dim()) = base.R_WB.transpose() * base.w_WB_W;
}

Vector3 PlantDynamics::specificForce(const BaseMotion& base,
                                     const BaseAcceleration& acceleration) const {
  const Vector3 r = base.R_WB * p_BI_B_;
  const Vector3 a = acceleration.a_WK_W + acceleration.alpha_WB_W.cross(r) +
                    base.w_WB_W.cross(base.w_WB_W.cross(r));
  return base.R_WB.transpose() * (a - gravity_W_);
}

}  // namespace ballbot
