#include "plant/series_elastic_actuator.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kSpeedDroop = 0.1;  // share of the speed range over which the peak torque is lost

}  // namespace

double actuatorFriction(const ActuatorParameters& p, double velocity) {
  const double ratio = velocity / p.stribeck_velocity;
  const double dry =
      p.coulomb_friction + (p.static_friction - p.coulomb_friction) * std::exp(-ratio * ratio);
  return p.viscous_friction * velocity + dry * std::tanh(velocity / p.friction_smoothing);
}

double torqueAtSpeed(const ActuatorParameters& p, double speed_in_torque_direction) {
  return p.peak_torque *
         std::max(0.0, (1 - speed_in_torque_direction / p.speed_limit) / kSpeedDroop);
}

void SeriesElasticActuator::demand(double motor_torque, double since_last) {
  start_ = motorTorque(since_last);
  demand_ = motor_torque;
}

double SeriesElasticActuator::motorTorque(double since_tick) const {
  if (!spring_) return demand_;
  return demand_ + (start_ - demand_) * std::exp(-kTwoPi * p_.current_loop_bandwidth * since_tick);
}

SeriesElasticActuator::Torques SeriesElasticActuator::torques(double since_tick,
                                                              const ActuatorMotion& m) const {
  const double motor_velocity = spring_ ? m.rotor_velocity : m.joint_velocity;
  double motor = motorTorque(since_tick);
  if (speed_limit_) {
    motor =
        std::clamp(motor, -torqueAtSpeed(p_, -motor_velocity), torqueAtSpeed(p_, motor_velocity));
  }
  if (!spring_) return {motor, 0};
  if (friction_) motor -= actuatorFriction(p_, motor_velocity);
  const double spring = p_.spring_stiffness * (m.rotor_angle - m.joint_angle) +
                        p_.spring_damping * (m.rotor_velocity - m.joint_velocity);
  return {spring, motor - spring};
}

}  // namespace ballbot
