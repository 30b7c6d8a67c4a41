#pragma once

#include "model/actuator_parameters.hpp"

namespace ballbot {

/// Angles and rates of one actuator: the rotor divided by the gear ratio, and the joint.
struct ActuatorMotion {
  double rotor_angle = 0, rotor_velocity = 0;  ///< [rad, rad/s]
  double joint_angle = 0, joint_velocity = 0;  ///< [rad, rad/s]
};

/// Friction between rotor and housing, seen from the joint: viscous, Coulomb and Stribeck, opposing
/// `velocity` [rad/s]; continuous through zero [N m]. docs/theory/actuator.md, eq. 3.
double actuatorFriction(const ActuatorParameters& p, double velocity);

/// The largest torque the motor can give in the direction of `velocity`: its voltage leaves none at
/// the speed limit, and saturates no torque up to the peak below 9/10 of it [N m].
double torqueAtSpeed(const ActuatorParameters& p, double speed_in_torque_direction);

/// Motor, gear, and spring of one joint between two ticks of its drive. All values are seen from
/// the joint side of the gear. The current loop is a first-order lag; its input is constant between
/// ticks, so it is solved in closed form and costs the integrator no state.
///
/// Without spring the actuator is ideal: the torque asked for, within the speed limit if there is
/// one, is on the joint at once. Friction is the rotor's, inside the torque loop, so an ideal
/// torque source has none whatever `friction` says.
class SeriesElasticActuator {
 public:
  SeriesElasticActuator(const ActuatorParameters& p, bool friction, bool speed_limit, bool spring)
      : p_(p), friction_(friction), speed_limit_(speed_limit), spring_(spring) {}

  /// No torque.
  void reset() { demand_ = start_ = 0; }

  /// At a drive tick, `since_last` [s] after the one before: the motor torque wanted from now on.
  void demand(double motor_torque, double since_last);

  /// Motor torque `since_tick` [s] after the last tick, before the speed limit [N m].
  double motorTorque(double since_tick) const;

  struct Torques {
    double joint;  ///< on the joint [N m]
    double rotor;  ///< on the rotor, all that acts on it; zero without spring [N m]
  };
  Torques torques(double since_tick, const ActuatorMotion& motion) const;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.demand_);
    visit(self.start_);
  }

 private:
  ActuatorParameters p_;
  bool friction_, speed_limit_, spring_;
  double demand_ = 0, start_ = 0;  ///< what the lag goes to and where it started from [N m]
};

}  // namespace ballbot
