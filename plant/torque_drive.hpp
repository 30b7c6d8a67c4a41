#pragma once

#include "core/time.hpp"
#include "model/actuator_parameters.hpp"

namespace ballbot {

/// What a drive reads from its two encoders at a tick.
struct DriveReading {
  double motor_angle = 0, motor_velocity = 0;  ///< behind the gear [rad, rad/s]
  double joint_angle = 0, joint_velocity = 0;  ///< behind the spring [rad, rad/s]
};

/// One joint's part of an ActuatorCommand.
struct DriveCommand {
  double torque = 0;                  ///< feedforward [N m]
  double position = 0;                ///< [rad]
  double velocity = 0;                ///< [rad/s]
  double stiffness = 0, damping = 0;  ///< [N m/rad, N m s/rad]
};

struct DriveOptions {
  bool torque_loop = true;         ///< false: the motor torque is the joint torque (no spring)
  bool saturation = true;          ///< of the motor torque, at its peak
  bool leak_compensation = false;  ///< feeds the rotor's own inertia and drag forward
  SimDuration period{400'000};
};

/// The digital part of an actuator, run once per tick:
///
///   tau_d = torque + stiffness (position - q) + damping (velocity - dq)
///   tau_m = tau_d + Kp (tau_d - k (theta_m - q)) - Kd k (dtheta_m - dq)   [+ compensation]
///
/// with gains from ActuatorParameters. docs/theory/actuator.md has the derivation, what of the
/// rotor leaks through to the joint, and what the compensation does.
class TorqueDrive {
 public:
  TorqueDrive(const ActuatorParameters& p, const DriveOptions& options);

  /// Joint torque wanted, before the torque loop [N m].
  static double wantedTorque(const DriveCommand& command, const DriveReading& reading);

  void reset() { slow_velocity_ = 0; }

  /// Motor torque to ask of the current loop until the next tick [N m], for a wanted joint torque.
  double tick(double wanted, const DriveReading& reading);

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.slow_velocity_);
  }

 private:
  ActuatorParameters p_;
  DriveOptions options_;
  double gain_p_, gain_d_;
  double filter_rate_, filter_share_;  ///< of the compensation's low-pass [1/s, per tick]
  double slow_velocity_ = 0;           ///< low-passed motor velocity [rad/s]
};

}  // namespace ballbot
