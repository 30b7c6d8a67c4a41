#include "controller/command_governor.hpp"

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

/// Stretched to the last, an arm can only be pulled in: what is asked for stays this much below.
constexpr double kShareOfReach = 0.98;

double reachOf(const RobotParameters& robot) {
  double reach = robot.p_A3E.norm();
  for (int i = 1; i < kArmJointCount; ++i) reach += robot.arm[i].p_PJ_P.norm();
  return reach;
}

template <typename Command>
void bound(Command& command, double step, double lead, double speed) {
  command.step = step;
  command.lead = lead;
  command.speed = speed;
}

Eigen::Matrix<double, 1, 1> scalar(double value) { return Eigen::Matrix<double, 1, 1>(value); }

}  // namespace

void CommandLimits::describe(ConfigVisitor& v) {
  v.number(may("step_m",
               "way of ball or end-effector that is asked for at once; what is farther is "
               "approached at a bounded speed"),
           step, {kTiny, 1e3});
  v.number(may("lead_m", "how far an approached place is ahead of its anchor; at most the step"),
           lead, v.depending({kTiny, step}));
  v.number(may("speed_m_per_s", "speed at which the ball's place is approached"), speed,
           {kTiny, 100});
  v.number(may("ee_speed_m_per_s", "speed at which the end-effector's place is approached"),
           ee_speed, {kTiny, 100});
  v.number(may("angle_step_rad",
               "turn of heading, end-effector or arm joints that is asked for at once"),
           angle_step, {kTiny, 1e3});
  v.number(
      may("angle_lead_rad", "how far an approached angle is ahead of its anchor; at most the step"),
      angle_lead, v.depending({kTiny, angle_step}));
  v.number(may("angle_speed_rad_per_s", "speed at which an angle is approached"), angle_speed,
           {kTiny, 100});
  v.number(may("lag_m", "largest distance of an anchor from the robot, for which it waits"), lag,
           {kTiny, 1e3});
  v.number(
      may("angle_lag_rad", "largest angle between an anchor and the robot, for which it waits"),
      angle_lag, {kTiny, 1e3});
  v.number(may("push_N",
               "largest force that the end-effector is asked to push with; what gives way "
               "to more outruns the robot"),
           push, {kTiny, 1e6});
}

CommandGovernor::CommandGovernor(const RobotParameters& robot, const CommandLimits& limits)
    : limits_(limits) {
  bound(commands_.ee_position, limits.step, limits.lead, limits.ee_speed);
  bound(commands_.ball_position, limits.step, limits.lead, limits.speed);
  bound(commands_.ee_orientation, limits.angle_step, limits.angle_lead, limits.angle_speed);
  bound(commands_.yaw, limits.angle_step, limits.angle_lead, limits.angle_speed);
  bound(commands_.arm_position, limits.angle_step, limits.angle_lead, limits.angle_speed);
  commands_.push = limits.push;
  const double shoulder = robot.ball.radius + robot.arm[0].p_PJ_P.z();
  const double reach = kShareOfReach * reachOf(robot);
  commands_.ee_position.lower.z() = shoulder - reach;
  commands_.ee_position.upper.z() = shoulder + reach;
  for (int i = 0; i < kArmJointCount; ++i) {
    commands_.arm_position.lower[i] = robot.arm[i].lower_limit;
    commands_.arm_position.upper[i] = robot.arm[i].upper_limit;
  }
}

void CommandGovernor::governAdded(const AddedTasks& tasks) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    GovernedAdded& command = commands_.added[i];
    command.kind = tasks[i]->commandKind();
    bound(command.place, limits_.step, limits_.lead, limits_.ee_speed);
    bound(command.orientation, limits_.angle_step, limits_.angle_lead, limits_.angle_speed);
  }
}

void CommandGovernor::followAdded(const Tasks& asked, double seconds,
                                  const StateVector& x) noexcept {
  for (std::size_t i = 0; i < asked.added->size(); ++i) {
    GovernedAdded& command = commands_.added[i];
    if (command.kind == CommandKind::kFree) continue;
    const TaskTarget& target = asked.added_target[i];
    if (!started_) command.start(target.reference);
    command.follow(target.reference, seconds, (*asked.added)[i]->present(x), limits_.lag,
                   limits_.angle_lag);
    cutting_ = cutting_ || (!target.weight.isZero(0) && command.cuts(target.reference));
  }
}

void CommandGovernor::update(SimTime now, const TaskSchedule& schedule, const StateVector& x,
                             const ReducedDynamics::EndEffector& tip) noexcept {
  const double t = toSeconds(now - kSimStart);
  const double seconds = started_ ? toSeconds(now - last_) : 0;
  Tasks asked;
  schedule.at(t, t, asked);
  if (!started_) {
    commands_.ee_position.anchor = asked.p_WE;
    commands_.ball_position.anchor = asked.ball_position;
    commands_.ee_orientation.anchor = asked.R_WE;
    commands_.yaw.anchor = scalar(asked.yaw);
    commands_.arm_position.anchor = asked.arm_position;
  }
  commands_.ee_position.follow(asked.p_WE, seconds, tip.p_WE, limits_.lag);
  commands_.ball_position.follow(asked.ball_position, seconds, x.segment<2>(kBallX), limits_.lag);
  commands_.yaw.follow(scalar(asked.yaw), seconds, scalar(x[kYaw]), limits_.angle_lag);
  commands_.arm_position.follow(asked.arm_position, seconds, x.segment<kArmJointCount>(kArm1),
                                limits_.angle_lag);
  commands_.ee_orientation.follow(asked.R_WE, seconds, tip.R_WE, limits_.angle_lag);
  cutting_ =
      (asked.inContact() && asked.contact_force_C.norm() > limits_.push) ||
      (!asked.ee_position_weight.isZero(0) && commands_.ee_position.cuts(asked.p_WE)) ||
      (!asked.ball_position_weight.isZero(0) &&
       commands_.ball_position.cuts(asked.ball_position)) ||
      (!asked.ee_orientation_weight.isZero(0) && commands_.ee_orientation.cuts(asked.R_WE)) ||
      (asked.yaw_weight != 0 && commands_.yaw.cuts(scalar(asked.yaw))) ||
      (!asked.arm_position_weight.isZero(0) && commands_.arm_position.cuts(asked.arm_position));
  if (asked.added != nullptr) followAdded(asked, seconds, x);
  started_ = true;
  last_ = now;
}

}  // namespace ballbot
