#pragma once

#include "controller/tasks.hpp"

namespace ballbot {

class ConfigVisitor;

struct ArmInverseKinematicsConfig {
  /// The base on which the arm reaches for its place in the world.
  enum class Base {
    kTask,       ///< at rest where the base's own tasks ask it to be: the arm feels nothing of it
    kEstimated,  ///< where it is: the arm makes up for the base's motion
  };
  Base base = Base::kTask;
  double gain = 4;        ///< rate at which an error of the pose is worked off [1/s]
  double damping = 0.1;   ///< share of the mean stiffness added: bounds rates near singular poses
  double rate_limit = 1;  ///< of each joint [rad/s]

  void describe(ConfigVisitor& v);
};

/// Differential inverse kinematics of the arm on a base that stands where it stands: joint rates
/// that lead the end-effector to its reference, by damped least squares with the tasks' own
/// weights,
///
///   dq = (J^T W J + lambda 1)^-1 J^T W (v_desired + gain * error),
///
/// all joints slowed down together where one would exceed its limit. Without an end-effector task
/// it leads to the tasks' arm position. May run in the control step.
class ArmInverseKinematics {
 public:
  ArmInverseKinematics(const RobotParameters& robot, const ArmInverseKinematicsConfig& config)
      : dynamics_(robot), config_(config) {}

  /// @param x  base and ball as estimated, the arm where its set-point is
  ArmVector rates(const StateVector& x, const Tasks& tasks) const noexcept;

  /// `arm` inside the joints' limits.
  ArmVector withinLimits(const ArmVector& arm) const noexcept;

 private:
  ReducedDynamics dynamics_;
  ArmInverseKinematicsConfig config_;
};

}  // namespace ballbot
