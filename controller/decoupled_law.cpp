#include "controller/decoupled_law.hpp"

#include "controller/rigid_arm.hpp"
#include "core/config_visitor.hpp"
#include "core/state_visitors.hpp"

namespace ballbot {
namespace {

constexpr char kBlobKind[] = "decoupled_law";
constexpr std::uint32_t kBlobVersion = 2;
constexpr double kNoLimit = 1e3;  ///< [rad]

/// The whole-body problem less everything that is about the arm.
MpcConfig baseOnly(MpcConfig c) {
  auto tasks = std::make_shared<TaskSchedule>(*c.schedule);
  tasks->ee_position_weight = tasks->ee_orientation_weight = TimedWeight<3>();
  tasks->ee_velocity_weight = tasks->ee_rate_weight = TimedWeight<3>();
  tasks->arm_position_weight = tasks->arm_rate_weight = TimedWeight<kArmJointCount>();
  tasks->contact_force_weight = TimedWeight<3>();
  tasks->added.clear();
  c.schedule = tasks;
  c.contact_forces = false;
  c.constraints.arm_lower.setConstant(-kNoLimit);
  c.constraints.arm_upper.setConstant(kNoLimit);
  return c;
}

}  // namespace

void ArmPidConfig::describe(ConfigVisitor& v) {
  v.number(may("stiffness_Nm_per_rad", "pull of each arm joint towards its angle"), stiffness,
           {0, 1e4});
  v.number(may("damping_Nms_per_rad", "pull of each arm joint towards its speed"), damping,
           {0, 1e3});
  v.number(may("integral_Nm_per_rad_s", "rate at which an error that stays adds torque"), integral,
           {0, 1e4});
  v.number(may("integral_limit_Nm", "largest torque that the integral adds"), integral_limit,
           {0, 1e3});
}

void DecoupledConfig::describe(ConfigVisitor& v) {
  v.section(may("inverse_kinematics", "how the arm follows the end-effector's reference"),
            [&](ConfigVisitor& in) { inverse_kinematics.describe(in); });
  v.section(may("pid", "gains of the arm's joints, about the torque that holds the arm still"),
            [&](ConfigVisitor& in) { pid.describe(in); });
}

DecoupledConfig DecoupledConfig::read(ConfigReader& in) {
  DecoupledConfig c;
  readDescribed(in, c);
  in.finish();
  return c;
}

DecoupledLaw::DecoupledLaw(const RobotParameters& robot, const MpcConfig& mpc,
                           const DecoupledConfig& config)
    : ik_base_(config.inverse_kinematics.base),
      dynamics_(robot),
      rest_(findEquilibrium(dynamics_, robot.nominal_arm).x),
      schedule_(mpc.schedule),
      known_payload_(robot.payload_mass),
      hand_by_nu_(dynamics_.endEffectorJacobian(rest_.head<kPositionDim>()).topRows<3>()),
      inverse_kinematics_(robot, config.inverse_kinematics),
      pid_(config.pid),
      base_(withRigidArm(robot, robot.nominal_arm), baseOnly(mpc)) {
  planned_.position = robot.nominal_arm;
  planned_.gravity = gravityTorque(rest_);
  active_ = planned_;
}

ArmVector DecoupledLaw::gravityTorque(const StateVector& x) const noexcept {
  return dynamics_.nonlinearEffects(x.head<kPositionDim>(), VelocityVector::Zero())
      .tail<kArmJointCount>();
}

PlanReport DecoupledLaw::plan(SimTime now, const StateVector& x,
                              const JointVector& joint_angle) noexcept {
  StateVector without_arm = x;
  without_arm.segment<kArmJointCount>(kArm1) = rest_.segment<kArmJointCount>(kArm1);
  without_arm.tail<kArmJointCount>().setZero();
  if (x.allFinite()) planArm(now, x);
  return base_.plan(now, without_arm, joint_angle);
}

void DecoupledLaw::planArm(SimTime now, const StateVector& x) noexcept {
  const ArmVector arm = x.segment<kArmJointCount>(kArm1);
  const double since = planned_.valid ? toSeconds(now - planned_.stamp) : 0;
  const ArmVector from =
      planned_.valid ? ArmVector(planned_.position + since * planned_.rate) : arm;
  planned_.position = inverse_kinematics_.withinLimits(from);
  planned_.integral = (planned_.integral + since * pid_.integral * (planned_.position - arm))
                          .cwiseMax(-pid_.integral_limit)
                          .cwiseMin(pid_.integral_limit);
  planned_.stamp = now;
  planned_.valid = true;

  Tasks tasks;
  schedule_->at(toSeconds(now), toSeconds(now), tasks);
  StateVector at_set_point = x;
  if (ik_base_ == ArmInverseKinematicsConfig::Base::kTask) {
    at_set_point = rest_;
    at_set_point.segment<2>(kBallX) = tasks.ball_position;
    at_set_point[kYaw] = tasks.yaw;
  }
  at_set_point.segment<kArmJointCount>(kArm1) = planned_.position;
  planned_.rate = inverse_kinematics_.rates(at_set_point, tasks);
  planned_.gravity = gravityTorque(at_set_point);
}

void DecoupledLaw::setCircumstances(const Circumstances& now) noexcept {
  const LastingForces& forces = now.lasting;
  const double payload = known_payload_ + forces.hand_mass;
  if (payload != dynamics_.robot().payload_mass) dynamics_.setPayload(payload);
  // To the base, whose model has no hand, the mass is a weight on the arm at its nominal pose. What
  // is left at the joints is their integrals' business.
  Circumstances of_base = now;
  LastingForces& on_base = of_base.lasting;
  on_base.hand_mass = 0;
  const Vector3 weight(0, 0, -forces.hand_mass * dynamics_.robot().gravity);
  on_base.rest = forces.rest + hand_by_nu_.transpose() * weight;
  on_base.rest.tail<kArmJointCount>().setZero();
  of_base.push.tail<kArmJointCount>().setZero();
  base_.setCircumstances(of_base);
}

void DecoupledLaw::activatePlan() noexcept {
  base_.activatePlan();
  active_ = planned_;
}

void DecoupledLaw::sample(SimTime now, PolicySample& out) const noexcept {
  base_.sample(now, out);
  constexpr int kRates = kPositionDim + kArmRate1;
  const ArmVector position = active_.position + toSeconds(now - active_.stamp) * active_.rate;
  out.x.segment<kArmJointCount>(kArm1) = position;
  out.x.tail<kArmJointCount>() = active_.rate;
  out.joint_position.tail<kArmJointCount>() = position;
  out.joint_velocity.tail<kArmJointCount>() = active_.rate;
  out.torque.tail<kArmJointCount>() = active_.gravity + active_.integral;
  out.feedback.bottomRows<kArmJointCount>().setZero();
  out.feedback.middleCols<kArmJointCount>(kArm1).setZero();
  out.feedback.middleCols<kArmJointCount>(kRates).setZero();
  for (int i = 0; i < kArmJointCount; ++i) {
    out.feedback(kWheelCount + i, kArm1 + i) = -pid_.stiffness;
    out.feedback(kWheelCount + i, kRates + i) = -pid_.damping;
  }
}

void DecoupledLaw::commanded(SimTime now, SimDuration period, const JointVector& torque) noexcept {
  base_.commanded(now, period, torque);
}

struct DecoupledLaw::State {
  ArmPlan planned, active;
  StateBlob base;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.planned);
    visit(self.active);
    visit(self.base);
  }
};

StateBlob DecoupledLaw::saveState() const {
  return saveStateOf(State{planned_, active_, base_.saveState()}, kBlobKind, kBlobVersion);
}

void DecoupledLaw::restoreState(const StateBlob& blob) {
  State next{planned_, active_, {}};
  restoreStateOf(next, blob, kBlobKind, kBlobVersion);
  base_.restoreState(next.base);
  planned_ = next.planned;
  active_ = next.active;
}

}  // namespace ballbot
