#pragma once

#include "controller/relaxed_barrier.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;

/// Inequalities the plan should keep, each as a relaxed barrier in the cost: torque limits and
/// friction cone as in the paper, and the limits of the arm and of the tilt.
struct Constraints {
  JointVector torque_limit = JointVector::Zero();  ///< [N m]
  RelaxedBarrier torque{0.05, 0.2};

  /// |tangential force| <= friction * normal force, made smooth by `cone_epsilon`:
  /// h = friction lz - sqrt(lx^2 + ly^2 + epsilon^2).
  double friction = 0.7;
  double cone_epsilon = 1;  ///< [N]
  RelaxedBarrier cone{0.1, 0.5};

  Vector3 arm_lower = Vector3::Zero(), arm_upper = Vector3::Zero();  ///< [rad]
  RelaxedBarrier arm_position{0.05, 0.01};

  double arm_rate_limit = 6;  ///< [rad/s]
  RelaxedBarrier arm_rate{0.02, 0.5};

  /// Of the wheels relative to the base; less than the drives give, whose torque is gone there [rad/s].
  double wheel_rate_limit;
  RelaxedBarrier wheel_rate{0.2, 0.2};

  double tilt_limit = 0.45;  ///< of the base from vertical [rad]
  RelaxedBarrier tilt{0.05, 0.02};

  explicit Constraints(const RobotParameters& robot);

  /// Keys, each optional: torque_limits, friction_cone, arm_position_limits, arm_rate_limits,
  /// wheel_rate_limits, tilt_limit; each with mu, delta, and what belongs to it.
  static Constraints read(ConfigReader& in, const RobotParameters& robot);
};

}  // namespace ballbot
