#pragma once

#include <limits>

#include "controller/control_law.hpp"
#include "model/robot_parameters.hpp"
#include "model/signals.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

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
  /// What the drives give, and so the most that `torque_limit` may be [N m].
  JointVector drive_torque = JointVector::Constant(std::numeric_limits<double>::infinity());
  double policy_feedback = 1;  ///< share of the policy's K (x - x_ref) used

  /// What a file that says nothing means: some stiffness, and the drives' whole torque.
  static TrackerConfig defaults(const RobotParameters& robot);
  void describe(ConfigVisitor& v);
  /// @throw InputError as ConfigReader, or where a limit is below what standing still takes.
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
