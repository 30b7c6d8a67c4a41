#pragma once

#include "model/robot_parameters.hpp"

namespace ballbot {

/// What the robot's balance is to first order: the robot with its arm held still, about standing
/// upright. Where it stands and which way it faces change nothing of that, so they are no part of
/// the state.
///
///   ds/dt = A s + B u + E f
///
/// s: pitch, roll [rad], ball velocity x, y in W [m/s], angular velocity of the base in B [rad/s];
/// u: wheel torques beyond those at rest [N m]; f: horizontal force x, y in W on a point of the
/// base [N]. A and B are the controller's own dynamic model (model/reduced_dynamics), linearised.
struct BalanceModel {
  static constexpr int kStates = 7;
  static constexpr int kPitchRow = 0, kRollRow = 1, kRates = 2;
  using State = Eigen::Matrix<double, kStates, 1>;
  using StateMatrix = Eigen::Matrix<double, kStates, kStates>;
  using TorqueMatrix = Eigen::Matrix<double, kStates, kWheelCount>;
  using ForceMatrix = Eigen::Matrix<double, kStates, 2>;

  StateMatrix A;
  TorqueMatrix B;
  ForceMatrix E;
  Eigen::Matrix<double, kWheelCount, kStates> wheel_rates;  ///< of s, relative to the base [rad/s]
  /// The floor's horizontal force on the ball is momentum_rate * ds/dt - f [N].
  Eigen::Matrix<double, 2, kStates> momentum_rate;
  Eigen::Matrix<double, kWheelCount, 1> torque_at_rest;  ///< [N m]

  /// Something of each wheel on the ball: at_rest + by_state s + by_torque u + by_force f.
  struct OfWheels {
    Vector3 at_rest = Vector3::Zero();
    Eigen::Matrix<double, kWheelCount, kStates> by_state =
        Eigen::Matrix<double, kWheelCount, kStates>::Zero();
    Matrix3 by_torque = Matrix3::Zero();
    Eigen::Matrix<double, kWheelCount, 2> by_force = Eigen::Matrix<double, kWheelCount, 2>::Zero();
  };
  OfWheels normal_force, traction;             ///< [N], as WheelLoadModel has them
  double pitch_at_rest = 0, roll_at_rest = 0;  ///< [rad]
  double weight = 0;                           ///< of everything [N]

  /// @param arm      angles at which the arm is held [rad]
  /// @param p_BP_B   where f acts, from the base's origin (the ball's centre) [m]
  /// @throw NumericalError if the robot cannot stand like that.
  static BalanceModel of(const RobotParameters& robot, const ArmVector& arm, const Vector3& p_BP_B);
};

/// The same over a time in which u and f stay what they are: s' = A s + B u + E f, exactly.
struct BalanceStep {
  BalanceModel::StateMatrix A;
  BalanceModel::TorqueMatrix B;
  BalanceModel::ForceMatrix E;

  BalanceStep(const BalanceModel& model, double duration_s);
};

}  // namespace ballbot
