#pragma once

#include "controller/control_law.hpp"
#include "model/robot_parameters.hpp"
#include "model/signals.hpp"

namespace ballbot {

class ConfigReader;

struct TrackerConfig {
  /// Who closes the PD loop on the joints.
  enum class PdLoop {
    kController,  ///< here; the drives get a plain torque command
    kDrives,      ///< the drives, faster than the bus; they get feedforward and set-points
  };
  PdLoop pd_loop = PdLoop::kController;
  JointVector stiffness = JointVector::Zero();     ///< K_P [N m/rad]
  JointVector damping = JointVector::Zero();       ///< K_D [N m s/rad]
  JointVector torque_limit = JointVector::Zero();  ///< of the command [N m]
  double policy_feedback = 1;                      ///< share of the policy's K (x - x_ref) used

  /// Keys: pd_loop, wheel_stiffness_Nm_per_rad, wheel_damping_Nms_per_rad, arm_..., and
  /// wheel_torque_limit_Nm, arm_torque_limit_Nm (default: the robot's, which they may not exceed),
  /// policy_feedback.
  static TrackerConfig read(ConfigReader& in, const RobotParameters& robot);
};

enum class TrackStatus { kOk, kTorqueSaturated, kNotFinite };

/// Follows a policy: tau = tau_ff + K (x - x_ref) + K_P (q_ff - q) + K_D (dq_ff - dq)
/// (Minniti et al. 2019, section IV). May run in the control step.
class PdTracker {
 public:
  explicit PdTracker(const TrackerConfig& config) : config_(config) {}

  /// One control tick. On kNotFinite `command` keeps what it held: the last good command.
  /// @param x            estimated state at this tick
  /// @param joint_angle  measured, wheels relative to the base [rad]
  /// @param joint_velocity  measured [rad/s]
  [[nodiscard]] TrackStatus step(const PolicySample& policy, const StateVector& x,
                                 const JointVector& joint_angle, const JointVector& joint_velocity,
                                 ActuatorCommand& command) const noexcept;

 private:
  TrackerConfig config_;
};

}  // namespace ballbot
