#pragma once

#include <deque>
#include <functional>

#include "model/actuator_parameters.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// A stand-in for the robot in controller tests: the reduced dynamics, each torque behind a
/// transport delay and a second-order lag. Controllers are judged on the multibody plant elsewhere;
/// this one is quick and needs no other folder.
struct LagParameters {
  double bandwidth_Hz = 40;  ///< of the torque loop (natural frequency)
  double damping_ratio = 0.707;
  int delay_steps = 2;  ///< of kStep each
};

class LaggedPlant {
 public:
  static constexpr double kStep = 4e-4;  ///< [s]

  LaggedPlant(const RobotParameters& robot, const LagParameters& lag, const StateVector& x);

  /// Force of the surroundings on the end-effector, from its motion [N]; none unless set.
  std::function<Vector3(const ReducedDynamics::EndEffector&)> touch;

  /// One step of kStep with the command held. `push_W` acts on the base 0.35 m above K [N].
  void step(const JointVector& command, const Vector3& push_W = Vector3::Zero());

  const StateVector& x() const { return x_; }
  const JointVector& torque() const { return torque_; }           ///< behind the lag [N m]
  const JointVector& jointAngle() const { return joint_angle_; }  ///< wheels integrated [rad]
  JointVector jointVelocity() const;
  double tilt() const;  ///< of the base's z from vertical [rad]

 private:
  StateVector derivative(const StateVector& x, const Vector3& push_W) const;

  ReducedDynamics dynamics_;
  LagParameters lag_;
  StateVector x_;
  JointVector torque_ = JointVector::Zero(), torque_rate_ = JointVector::Zero();
  JointVector joint_angle_ = JointVector::Zero();
  std::deque<JointVector> on_the_way_;
};

}  // namespace ballbot
