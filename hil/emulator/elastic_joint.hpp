#pragma once

#include <cstdint>
#include <deque>
#include <utility>

#include "hil/emulator/test_stand.hpp"
#include "model/actuator_parameters.hpp"
#include "plant/torque_drive.hpp"

namespace ballbot {

/// One series elastic joint of a test stand. What the plant's actuators do not have is zero unless
/// asked for.
struct ElasticJointParameters {
  ActuatorParameters actuator;
  double load_friction = 0;  ///< of the gear, share of the torque that goes through it
  double backlash = 0;       ///< between gear and spring, from flank to flank [rad]
  double command_delay = 0;  ///< of torque commands, rounded up to the drive's tick [s]
  double load_inertia = 0.05, load_damping = 0.2;  ///< on a free output [kg m^2, N m s/rad]
  // Standard deviations of a sample: white, drawn anew for each.
  double motor_angle_noise = 0, joint_angle_noise = 0;  ///< [rad]
  double motor_torque_noise = 0;                        ///< of the mean over a cycle [N m]

  /// What its data sheet would promise, see ActuatorParameters for the actuator's keys.
  void describe(ConfigVisitor& v);
};

/// Motor, gear, backlash, spring and output, all seen from the joint (docs/theory/actuator.md):
///
///   J_r theta_m'' = tau_m - tau_s - F(theta_m') - load_friction |tau_s| tanh(theta_m' / v0)
///   tau_s = k dz(theta_m - theta_l) + b_s (theta_m' - theta_l') where a flank is touched
///
/// dz leaves out half the backlash on either side. The drive is the plant's TorqueDrive at ticks of
/// 0.1 ms: it takes k (theta_m - theta_l) for the spring's torque, as it has encoders and no more.
/// Fourth-order steps of a tick.
class ElasticJoint {
 public:
  static constexpr double kTick = 1e-4;  ///< [s]

  explicit ElasticJoint(const ElasticJointParameters& p);

  StandOutput output() const { return output_; }
  /// From rest: what it held or turned stands still.
  void setOutput(StandOutput output);
  /// @param dt  a whole number of ticks
  void advance(double dt, const DriveCommand& command);

  double motorAngle() const { return x_.motor_angle; }        ///< [rad]
  double jointAngle() const { return x_.joint_angle; }        ///< [rad]
  double jointVelocity() const { return x_.joint_velocity; }  ///< [rad/s]
  /// Between its flanks and the joint [N m].
  double springTorque() const { return springTorque(x_); }
  double meanMotorTorque() const { return mean_motor_torque_; }  ///< over the last advance() [N m]
  const ElasticJointParameters& parameters() const { return p_; }

 private:
  struct State {
    double motor_angle = 0, motor_velocity = 0, joint_angle = 0, joint_velocity = 0;
  };
  State slope(const State& x, double motor_torque) const;
  double springTorque(const State& x) const;
  void tick(const DriveCommand& command);
  void turnByHand();
  bool atRest(const DriveCommand& command) const;

  ElasticJointParameters p_;
  TorqueDrive drive_;
  StandOutput output_ = StandOutput::kFree;
  State x_;
  double motor_torque_ = 0;  ///< of the current loop, at the last tick [N m]
  double mean_motor_torque_ = 0;
  std::deque<std::pair<std::int64_t, DriveCommand>> on_the_way_;  ///< tick at which they act, what
  DriveCommand acting_;
  std::int64_t ticks_ = 0;
  double hand_ = 0;               ///< how much of its speed the hand has reached, 0 to 1
  double hand_time_ = 0;          ///< along its motion [s]
  std::int64_t quiet_ticks_ = 0;  ///< since there was torque
};

}  // namespace ballbot
