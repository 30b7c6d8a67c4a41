#pragma once

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// One series elastic actuator, seen from the joint (link side of the gear).
/// Figures of the ANYdrive class; see docs/theory/actuator.md for their sources.
struct ActuatorParameters {
  double gear_ratio = 50;
  double motor_inertia = 4e-5;          ///< rotor, motor side [kg m^2]
  double spring_stiffness = 350;        ///< [N m/rad]
  double spring_damping = 0.2;          ///< [N m s/rad]
  double viscous_friction = 0.3;        ///< B, at the rotor, link side units [N m s/rad]
  double coulomb_friction = 0.5;        ///< Fc [N m]
  double static_friction = 0.65;        ///< Fs [N m]
  double stribeck_velocity = 0.05;      ///< vs [rad/s]
  double friction_smoothing = 0.005;    ///< v0 of the tanh [rad/s]
  double peak_torque = 40;              ///< saturation of the motor torque [N m]
  double speed_limit = 12;              ///< of the motor, link side [rad/s]
  double current_loop_bandwidth = 500;  ///< first-order lag [Hz]
  double torque_bandwidth = 40;         ///< wanted closed-loop bandwidth, output blocked [Hz]
  double damping_ratio = 0.70710678118654752;  ///< wanted, output blocked

  /// Rotor inertia seen at the joint [kg m^2].
  double reflectedInertia() const { return gear_ratio * gear_ratio * motor_inertia; }

  /// Gains of tau_m = tau_d + Kp (tau_d - tau_s) - Kd k (dtheta_m - dtheta_l) that give the wanted
  /// bandwidth and damping with the output blocked.
  double torqueGainP() const;
  double torqueGainD() const;

  /// A reader refuses what needs a negative gain.
  void describe(ConfigVisitor& v);
  static ActuatorParameters read(ConfigReader& in);

 private:
  void requirePossible(const ConfigReader& in) const;
};

}  // namespace ballbot
