#pragma once

#include <Eigen/Core>

#include "core/time.hpp"
#include "model/reduced_dynamics.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// The plant to first order about the robot at rest with its arm in the nominal pose: rigid bodies
/// on a ball that rolls without spin, springs and rotors, the lag of the current loops, encoders
/// and the drives' torque loops as they are sampled. Fidelity switches count; what is not linear
/// does not: dry friction, noise, quantisation, limits. All values are deviations from rest.
class LoopPlant {
 public:
  /// State: x (16), deflection of the springs (6), rotor rates (6), motor torques (6), what is
  /// asked of the motors (6); then what the drives keep: motor and joint angles at the last tick,
  /// their low-passed rates, the compensation's slow rates (6 each).
  enum Index : int {
    kX = 0,
    kDeflection = kStateDim,
    kRotorRate = kDeflection + kJointCount,
    kMotor = kRotorRate + kJointCount,
    kFlightDim = kMotor + kJointCount,
    kDemand = kFlightDim,
    kMotorAngle = kDemand + kJointCount,
    kJointAngle = kMotorAngle + kJointCount,
    kMotorVelocity = kJointAngle + kJointCount,
    kJointVelocity = kMotorVelocity + kJointCount,
    kSlowVelocity = kJointVelocity + kJointCount,
    kDim = kSlowVelocity + kJointCount
  };
  using State = Eigen::Matrix<double, kDim, 1>;
  using StateRef = Eigen::Ref<State>;
  using ConstStateRef = Eigen::Ref<const State>;
  /// From the flying part of a state, and what is asked of the motors meanwhile, to where it is.
  using Flight = Eigen::Matrix<double, kFlightDim, kFlightDim + kJointCount>;

  /// @throw NumericalError if the robot has no equilibrium in its nominal pose.
  explicit LoopPlant(const PlantConfig& config);

  /// The way over a time in which no drive acts.
  Flight flightOver(SimDuration time) const;
  static void fly(const Flight& flight, StateRef z);

  /// First half of a drives' tick: encoders.
  void sense(StateRef z) const;
  /// Second half: the torques that are wanted on the joints [N m].
  void act(const JointVector& wanted, StateRef z) const;

  /// As a sensor frame has them, now [rad, rad/s].
  JointVector jointAngle(const ConstStateRef& z) const;
  JointVector jointVelocity(const ConstStateRef& z) const;

  /// Angle rates by angular velocity in B.
  const Matrix3& angleRates() const { return angle_rates_; }

 private:
  /// Of a drive: torque wanted, motor angle and rate, joint angle and rate, slow rate.
  using DriveInput = Eigen::Matrix<double, 6, 1>;

  JointVector trueVelocity(const ConstStateRef& z) const;
  /// What the drives themselves make of each of their inputs: they are linear.
  void askDrives();

  PlantConfig config_;
  bool elastic_, ideal_encoders_;
  Eigen::Matrix<double, kJointCount, kPositionDim> angles_by_q_;
  SelectionMatrix rates_by_nu_;
  Matrix3 angle_rates_;
  Eigen::Matrix<double, kJointCount, 6> demand_, slow_velocity_;       ///< by DriveInput
  Eigen::Matrix<double, kFlightDim, kFlightDim + kJointCount> rates_;  ///< d/dt of the flying part
};

}  // namespace ballbot
