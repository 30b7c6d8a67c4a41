#include "controller/terminal_cost.hpp"

#include <Eigen/Geometry>

#include "core/config_visitor.hpp"

namespace ballbot {

void TerminalCost::describe(ConfigVisitor& v) {
  v.choice(may("kind",
               "what the end of the horizon costs: its state's cost rate once more, or the "
               "value of balancing on by the LQR"),
           kind, {{"scaled_state", Kind::kScaledState}, {"lqr", Kind::kLqr}});
  v.number(may("state_scale_s", "time for which the last state's cost rate counts once more"),
           state_scale, {0, 1e3});
  v.number(may("lqr_scale", "factor on the LQR's value"), lqr_scale, {0, 1e3});
}

LqrTerminalCost::LqrTerminalCost(const RobotParameters& robot, const TerminalCost& terminal)
    : lqr_(designLqr(ReducedDynamics(robot), robot.nominal_arm, terminal.lqr_weights)),
      p_KE_(ReducedDynamics(robot).endEffector(lqr_.equilibrium.x).p_WE.head<2>()),
      scale_(terminal.lqr_scale) {}

StateVector LqrTerminalCost::error(const StateVector& x, const Tasks& tasks,
                                   StateVector& counts) const noexcept {
  StateVector rest = lqr_.equilibrium.x;
  counts.setOnes();
  const bool has_yaw = tasks.yaw_weight > 0;
  rest[kYaw] = has_yaw ? tasks.yaw : x[kYaw];
  rest.segment<kArmJointCount>(kArm1) = tasks.arm_position;
  const Eigen::Vector2d beside = Eigen::Rotation2Dd(rest[kYaw]) * p_KE_;
  for (int i = 0; i < 2; ++i) {
    if (tasks.ball_position_weight[i] > 0) {
      rest[kBallX + i] = tasks.ball_position[i];
    } else if (tasks.ee_position_weight[i] > 0) {
      rest[kBallX + i] = tasks.p_WE[i] - beside[i];
    } else {
      counts[kBallX + i] = 0;
    }
  }
  if (!has_yaw) counts[kYaw] = 0;
  return (x - rest).cwiseProduct(counts);
}

StateJacobian LqrTerminalCost::weight(const Tasks& tasks,
                                      const StateVector& counts) const noexcept {
  // P belongs to a robot that faces x; positions and velocities in W are turned into its heading.
  StateJacobian to_heading = StateJacobian::Identity();
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-tasks.yaw).toRotationMatrix();
  to_heading.block<2, 2>(kBallX, kBallX) = R;
  to_heading.block<2, 2>(kPositionDim + kBallVx, kPositionDim + kBallVx) = R;
  return scale_ * (counts.asDiagonal() * (to_heading.transpose() * lqr_.P * to_heading) *
                   counts.asDiagonal());
}

double LqrTerminalCost::value(const StateVector& x, const Tasks& tasks) const noexcept {
  StateVector counts;
  const StateVector e = error(x, tasks, counts);
  return 0.5 * e.dot(weight(tasks, counts) * e);
}

double LqrTerminalCost::expand(const StateVector& x, const Tasks& tasks,
                               ValueFunction<kMpcStateDim>& out) const noexcept {
  constexpr int kX = ValueFunction<kMpcStateDim>::kX;
  StateVector counts;
  const StateVector e = error(x, tasks, counts);
  const StateJacobian P = weight(tasks, counts);
  const StateVector gradient = P * e;
  for (int j = 0; j < kStateDim; ++j) {
    for (int i = 0; i < kStateDim; ++i) out.S_aug[j * kX + i] += P(i, j);
    out.S_aug[j * kX + kMpcStateDim] += gradient[j];
    out.S_aug[kMpcStateDim * kX + j] += gradient[j];
  }
  return 0.5 * e.dot(gradient);
}

}  // namespace ballbot
