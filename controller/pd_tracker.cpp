#include "controller/pd_tracker.hpp"

#include "controller/reference_limits.hpp"
#include "core/config_reader.hpp"

namespace ballbot {
namespace {

JointVector wheelsAndArm(double wheels, double arm) {
  JointVector out;
  out << Vector3::Constant(wheels), Vector3::Constant(arm);
  return out;
}

}  // namespace

TrackerConfig TrackerConfig::read(ConfigReader& in, const RobotParameters& robot) {
  TrackerConfig c;
  c.pd_loop =
      in.choiceOr<PdLoop>("pd_loop", PdLoop::kController,
                          {{"controller", PdLoop::kController}, {"drives", PdLoop::kDrives}});
  c.stiffness = wheelsAndArm(in.numberOr("wheel_stiffness_Nm_per_rad", 0.2, {0, 1000}),
                             in.numberOr("arm_stiffness_Nm_per_rad", 8, {0, 1000}));
  c.damping = wheelsAndArm(in.numberOr("wheel_damping_Nms_per_rad", 0.02, {0, 100}),
                           in.numberOr("arm_damping_Nms_per_rad", 0.6, {0, 100}));
  c.torque_limit = wheelsAndArm(
      in.numberOr("wheel_torque_limit_Nm", robot.wheel_torque_limit,
                  {kTiny, robot.wheel_torque_limit}),
      in.numberOr("arm_torque_limit_Nm", robot.arm_torque_limit, {kTiny, robot.arm_torque_limit}));
  c.policy_feedback = in.numberOr("policy_feedback", c.policy_feedback, {0, 1});
  in.finish();
  requireStaticTorque(robot, robot.nominal_arm, c.torque_limit, in.at("arm_torque_limit_Nm"));
  return c;
}

TrackStatus PdTracker::step(const PolicySample& policy, const StateVector& x,
                            const JointVector& joint_angle, const JointVector& joint_velocity,
                            ActuatorCommand& command) const noexcept {
  const JointVector pd = config_.stiffness.cwiseProduct(policy.joint_position - joint_angle) +
                         config_.damping.cwiseProduct(policy.joint_velocity - joint_velocity);
  const StateVector error = x - policy.x;
  const JointVector policy_torque =
      policy.torque + config_.policy_feedback * (policy.feedback * error);
  const JointVector wanted = policy_torque + pd;
  if (!wanted.allFinite()) return TrackStatus::kNotFinite;

  const JointVector& limit = config_.torque_limit;
  if (config_.pd_loop == TrackerConfig::PdLoop::kController) {
    command = ActuatorCommand{};
    command.torque = wanted.cwiseMax(-limit).cwiseMin(limit);
  } else {
    // The drives cut the sum; what is sent is cut too, so that a limit below theirs still holds.
    command.torque = policy_torque.cwiseMax(-limit).cwiseMin(limit);
    command.position = policy.joint_position;
    command.velocity = policy.joint_velocity;
    command.stiffness = config_.stiffness;
    command.damping = config_.damping;
  }
  const bool saturated = (wanted.cwiseAbs().array() > limit.array()).any();
  return saturated ? TrackStatus::kTorqueSaturated : TrackStatus::kOk;
}

}  // namespace ballbot
