#include "controller/pd_tracker.hpp"

#include "controller/reference_limits.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

JointVector wheelsAndArm(double wheels, double arm) {
  JointVector out;
  out << WheelVector::Constant(wheels), ArmVector::Constant(arm);
  return out;
}

/// A key for all wheels and one for all joints of the arm.
void describePair(ConfigVisitor& v, const ConfigKey& wheel_key, const ConfigKey& arm_key,
                  JointVector& values, Range wheel_range, Range arm_range) {
  double wheels = values[0], arm = values[kWheelCount];
  v.number(wheel_key, wheels, wheel_range);
  v.number(arm_key, arm, arm_range);
  values = wheelsAndArm(wheels, arm);
}

}  // namespace

TrackerConfig TrackerConfig::defaults(const RobotParameters& robot) {
  TrackerConfig c;
  c.stiffness = wheelsAndArm(0.2, 8);
  c.damping = wheelsAndArm(0.02, 0.6);
  c.torque_limit = c.drive_torque = wheelsAndArm(robot.wheel_torque_limit, robot.arm_torque_limit);
  return c;
}

void TrackerConfig::describe(ConfigVisitor& v) {
  v.choice(may("pd_loop",
               "who closes the loop on the joints: the tracker, or the drives, which are "
               "faster than the bus"),
           pd_loop, {{"controller", PdLoop::kController}, {"drives", PdLoop::kDrives}});
  describePair(v,
               may("wheel_stiffness_Nm_per_rad",
                   "pull of each wheel towards the angle that the plan has for it"),
               may("arm_stiffness_Nm_per_rad",
                   "pull of each arm joint towards the angle that the plan has for it"),
               stiffness, {0, 1000}, {0, 1000});
  describePair(v,
               may("wheel_damping_Nms_per_rad",
                   "pull of each wheel towards the speed that the plan has for it"),
               may("arm_damping_Nms_per_rad",
                   "pull of each arm joint towards the speed that the plan has for it"),
               damping, {0, 100}, {0, 100});
  describePair(
      v,
      may("wheel_torque_limit_Nm",
          "largest torque commanded to a wheel; by default and at most what its drive gives"),
      may("arm_torque_limit_Nm",
          "largest torque commanded to an arm joint; by default and at most what its drive gives"),
      torque_limit, v.depending({kTiny, drive_torque[0]}),
      v.depending({kTiny, drive_torque[kWheelCount]}));
  v.number(may("policy_feedback",
               "share of the plan's own feedback that is used; with 0 only its feedforward is"),
           policy_feedback, {0, 1});
}

TrackerConfig TrackerConfig::read(ConfigReader& in, const RobotParameters& robot) {
  TrackerConfig c = defaults(robot);
  readDescribed(in, c);
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
