#include "controller/lqr_law.hpp"

#include <algorithm>

#include "controller/lasting_load.hpp"
#include "controller/reference_limits.hpp"
#include "core/config_visitor.hpp"
#include "core/state_visitors.hpp"

namespace ballbot {
namespace {

constexpr char kBlobKind[] = "lqr_law";
constexpr std::uint32_t kBlobVersion = 1;

}  // namespace

LqrLawConfig LqrLawConfig::defaults(const RobotParameters& robot) {
  LqrLawConfig c;
  c.set_point.arm = robot.nominal_arm;
  return c;
}

void LqrLawConfig::describe(ConfigVisitor& v) {
  v.section(may("set_point", "where the robot should stand"),
            [&](ConfigVisitor& in) { set_point.describe(in); });
  v.section(
      may("weights", "weights of the cost that the law minimises, quadratic in errors and torques"),
      [&](ConfigVisitor& in) { weights.describe(in); });
  v.number(
      may("position_error_limit_m",
          "distance from the set point beyond which the law sees no more: the robot cruises there"),
      position_error_limit, {kTiny, 100});
  v.number(may("yaw_error_limit_rad", "error of the heading beyond which the law sees no more"),
           yaw_error_limit, {kTiny, 100});
}

LqrLawConfig LqrLawConfig::read(ConfigReader& in, const RobotParameters& robot) {
  LqrLawConfig c = defaults(robot);
  readDescribed(in, c);
  if (in.has("set_point")) c.set_point.requireWithinLimits(in.child("set_point"), robot);
  in.finish();
  JointVector torque_limit;
  torque_limit << WheelVector::Constant(robot.wheel_torque_limit),
      ArmVector::Constant(robot.arm_torque_limit);
  requireStaticTorque(robot, c.set_point.arm, torque_limit, in.at("set_point"));
  return c;
}

LqrLaw::LqrLaw(const RobotParameters& robot, const LqrLawConfig& config)
    : config_(config),
      dynamics_(robot),
      solution_(designLqr(dynamics_, config.set_point.arm, config.weights)),
      known_payload_(robot.payload_mass) {
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    WheelFlags lost{};
    lost[i] = true;
    without_[i] = designLqr(dynamics_, config.set_point.arm, config.weights, lost).K;
  }
  StateVector at_set_point = solution_.equilibrium.x;
  at_set_point.segment<2>(kBallX) = config_.set_point.ball_position;
  at_set_point[kYaw] = config_.set_point.yaw;
  planned_ = planFor(kSimStart, at_set_point, JointVector::Zero());
  active_ = planned_;
}

LqrLaw::Plan LqrLaw::planFor(SimTime now, const StateVector& x,
                             const JointVector& joint_angle) const noexcept {
  Plan plan;
  plan.stamp = now;
  PolicySample& p = plan.at_stamp;

  p.x = solution_.equilibrium.x;
  const Eigen::Vector2d error = config_.set_point.ball_position - x.segment<2>(kBallX);
  const double distance = error.norm();
  const double cut =
      distance > config_.position_error_limit ? config_.position_error_limit / distance : 1.0;
  p.x.segment<2>(kBallX) = x.segment<2>(kBallX) + cut * error;
  p.x[kYaw] = x[kYaw] + std::clamp(config_.set_point.yaw - x[kYaw], -config_.yaw_error_limit,
                                   config_.yaw_error_limit);

  p.torque = solution_.equilibrium.tau;
  LastingLoad load;
  StateVector at = p.x;
  at[kYaw] = x[kYaw];
  if (!lasting_.none() && findLastingLoad(dynamics_, at, lasting_.rest, load)) {
    p.x.segment<2>(kPitch) = load.x.segment<2>(kPitch);
    p.torque = load.torque;
  }
  const auto lost = std::find(lost_.begin(), lost_.end(), true);
  p.feedback = gainAtYaw(
      lost == lost_.end() ? solution_.K : without_[static_cast<std::size_t>(lost - lost_.begin())],
      x[kYaw]);

  p.joint_position.head<kWheelCount>() = joint_angle.head<kWheelCount>();
  p.joint_position.tail<kArmJointCount>() = config_.set_point.arm;
  p.joint_velocity = dynamics_.selectionMatrix(x.head<kPositionDim>()) * x.tail<kVelocityDim>();
  p.joint_velocity.tail<kArmJointCount>().setZero();
  return plan;
}

void LqrLaw::setCircumstances(const Circumstances& now) noexcept {
  lasting_ = now.lasting;
  lost_ = now.lost_wheels;
  const double payload = known_payload_ + lasting_.hand_mass;
  if (payload != dynamics_.robot().payload_mass) dynamics_.setPayload(payload);
}

PlanReport LqrLaw::plan(SimTime now, const StateVector& x,
                        const JointVector& joint_angle) noexcept {
  PlanReport report;
  report.accepted = x.allFinite() && joint_angle.allFinite();
  if (!report.accepted) return report;
  planned_ = planFor(now, x, joint_angle);
  report.step_length = 1;
  const StateVector error = x - planned_.at_stamp.x;
  report.cost = 0.5 * error.dot(solution_.P * error);
  return report;
}

void LqrLaw::sampleOf(const Plan& plan, SimTime now, PolicySample& out) noexcept {
  out = plan.at_stamp;
  out.joint_position += toSeconds(now - plan.stamp) * out.joint_velocity;
}

void LqrLaw::sample(SimTime now, PolicySample& out) const noexcept { sampleOf(active_, now, out); }

StateBlob LqrLaw::saveState() const { return saveStateOf(*this, kBlobKind, kBlobVersion); }

void LqrLaw::restoreState(const StateBlob& blob) {
  restoreStateOf(*this, blob, kBlobKind, kBlobVersion);
}

}  // namespace ballbot
