#include "controller/constraints.hpp"

#include <algorithm>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

void describeBarrier(ConfigVisitor& v, RelaxedBarrier& barrier) {
  v.number(may("mu", "weight of the barrier; larger keeps farther away from the limit"), barrier.mu,
           {0, 1e6});
  v.number(may("delta",
               "distance from the limit, in its unit, below which the barrier is a parabola, "
               "finite even beyond the limit"),
           barrier.delta, {1e-6, 1e6});
}

// Of the range of a joint or a torque, on each side.
constexpr double kFar = 0.1;

/// Of both barriers of one coordinate.
double wish(const RelaxedBarrier& barrier, double value, double lower, double upper) {
  const double far = std::max(kFar * (upper - lower), barrier.delta);
  return barrier.derivatives(std::max(value - lower, far)).first -
         barrier.derivatives(std::max(upper - value, far)).first;
}

}  // namespace

ArmVector Constraints::armPositionWish(const ArmVector& arm) const {
  ArmVector out;
  for (int i = 0; i < kArmJointCount; ++i) {
    out[i] = wish(arm_position, arm[i], arm_lower[i], arm_upper[i]);
  }
  return out;
}

ArmVector Constraints::armTorqueWish(const ArmVector& tau) const {
  ArmVector out;
  for (int i = 0; i < kArmJointCount; ++i) {
    const double limit = torque_limit[kWheelCount + i];
    out[i] = wish(torque, tau[i], -limit, limit);
  }
  return out;
}

Constraints::Constraints(const RobotParameters& robot) { takeShares(robot); }

void Constraints::takeShares(const RobotParameters& robot) {
  torque_limit << WheelVector::Constant(robot.wheel_torque_limit),
      ArmVector::Constant(robot.arm_torque_limit);
  torque_limit *= torque_share;
  wheel_rate_limit = wheel_rate_share * robot.wheel_speed_limit;
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& joint = robot.arm[i];
    // Of a range too narrow for it the middle half is left.
    const double margin =
        std::min(arm_position_margin, 0.25 * (joint.upper_limit - joint.lower_limit));
    arm_lower[i] = joint.lower_limit + margin;
    arm_upper[i] = joint.upper_limit - margin;
  }
}

void Constraints::describe(ConfigVisitor& v) {
  v.section(may("torque_limits", "barrier at the largest torque of each joint"),
            [&](ConfigVisitor& in) {
              describeBarrier(in, torque);
              in.number(may("share_of_limit", "share of the drive's torque that a plan may use"),
                        torque_share, {0.1, 1});
            });
  v.section(may("friction_cone", "barrier at the force across the contact at which it would slide"),
            [&](ConfigVisitor& in) {
              describeBarrier(in, cone);
              in.number(
                  may("friction", "largest force across the contact per force along its normal"),
                  friction, {0.01, 10});
              in.number(may("epsilon_N", "force over which the tip of the cone is rounded"),
                        cone_epsilon, {1e-3, 1e3});
            });
  v.section(may("arm_position_limits", "barrier at the stops of the arm's joints"),
            [&](ConfigVisitor& in) {
              describeBarrier(in, arm_position);
              in.number(may("margin_rad", "distance from the stops at which the barrier stands"),
                        arm_position_margin, {0, 1});
            });
  v.section(may("arm_rate_limits", "barrier at the largest speed of the arm's joints"),
            [&](ConfigVisitor& in) {
              describeBarrier(in, arm_rate);
              in.number(may("limit_rad_per_s", "largest speed of an arm joint"), arm_rate_limit,
                        {0.1, 100});
            });
  v.section(may("wheel_rate_limits",
                "barrier at the largest speed of the wheels, above which they cannot brake a fall"),
            [&](ConfigVisitor& in) {
              describeBarrier(in, wheel_rate);
              in.number(may("share_of_limit", "share of the drive's speed that a plan may use"),
                        wheel_rate_share, {0.1, 1});
            });
  v.section(may("spin_torque_limit",
                "barrier at the torque about the vertical beyond which the ball would spin on its "
                "floor; in effect where controller.floor.limited"),
            [&](ConfigVisitor& in) {
              describeBarrier(in, spin_torque);
              in.number(may("share_of_limit", "share of what the floor holds that a plan may use"),
                        spin_torque_share, {0.1, 1});
            });
  v.section(
      may("traction",
          "cost of traction at the wheels beyond what friction holds (robot.wheels.friction)"),
      [&](ConfigVisitor& in) {
        in.number(may("weight", "of half the square of the torque beyond, at the wheel's axle"),
                  traction_weight, {0, 1e6});
        in.number(may("share_of_limit", "share of what friction holds that a plan may use"),
                  traction_share, {0.1, 1});
      });
  v.section(may("tilt_limit", "barrier at the largest tilt of the base"), [&](ConfigVisitor& in) {
    describeBarrier(in, tilt);
    in.number(may("limit_deg", "largest angle of the base from the vertical"), tilt_limit, {1, 80},
              kRadPerDeg);
  });
}

}  // namespace ballbot
