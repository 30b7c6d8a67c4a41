#pragma once

#include "model/robot_parameters.hpp"
#include "solver/relaxed_barrier.hpp"

namespace ballbot {

class ConfigVisitor;

/// Inequalities the plan should keep, each as a relaxed barrier in the cost: torque limits and
/// friction cone as in the paper, and the limits of the arm and of the tilt.
struct Constraints {
  double torque_share = 1;                         ///< of the drives' torque that may be used
  JointVector torque_limit = JointVector::Zero();  ///< [N m]
  RelaxedBarrier torque{0.05, 0.2};

  /// |tangential force| <= friction * normal force, made smooth by `cone_epsilon`:
  /// h = friction lz - sqrt(lx^2 + ly^2 + epsilon^2).
  double friction = 0.7;
  double cone_epsilon = 1;  ///< [N]
  RelaxedBarrier cone{0.1, 0.5};

  double arm_position_margin = 0.05;  ///< that plans keep from the stops, for what drives lag [rad]
  ArmVector arm_lower = ArmVector::Zero(), arm_upper = ArmVector::Zero();  ///< [rad]
  RelaxedBarrier arm_position{0.05, 0.003};

  double arm_rate_limit = 6;  ///< [rad/s]
  RelaxedBarrier arm_rate{0.02, 0.5};

  /// Of the wheels relative to the base; less than the drives give, whose torque is gone there
  /// [rad/s].
  double wheel_rate_limit = 0;
  double wheel_rate_share = 0.7;  ///< of the drives' speed, which the limit is
  RelaxedBarrier wheel_rate{0.2, 0.2};

  /// Of the wheels on the ball about the vertical: what the floor under the ball is counted on to
  /// hold [N m]. Without end where nobody said what that is.
  double spin_torque_limit = kUnlimited;
  double spin_torque_share = 0.7;  ///< of what the floor holds, which the limit is
  RelaxedBarrier spin_torque{0.02, 0.05};

  /// Cost of what the wheels lack in traction, at half its square in N m; 0: they lack none
  /// [1/(N m)^2].
  double traction_weight = 20;
  double traction_share = 0.7;  ///< of what friction holds, from which on they lack it

  double tilt_limit = 0.45;  ///< of the base from vertical [rad]
  RelaxedBarrier tilt{0.05, 0.02};

  explicit Constraints(const RobotParameters& robot);

  /// Slopes of the barriers at the arm's stops, and at its largest torques, where nothing is near:
  /// there a barrier is no limit but a wish for the middle, which moves a robot that stands. From
  /// `far` on each side counts as if it were that near.
  ArmVector armPositionWish(const ArmVector& arm) const;   ///< [1/rad]
  ArmVector armTorqueWish(const ArmVector& torque) const;  ///< [1/(N m)]

  void describe(ConfigVisitor& v);
  /// @param held  torque that the floor holds; kUnlimited without end [N m]
  void takeFloor(double held) noexcept {
    spin_torque_limit = held < kUnlimited ? spin_torque_share * held : kUnlimited;
  }
  /// Sets the limits that follow from the robot's; to be called again after a share was read.
  void takeShares(const RobotParameters& robot);
};

}  // namespace ballbot
