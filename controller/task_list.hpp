#pragma once

#include <Eigen/Core>

// Every task that the whole-body cost has a kernel for, once. Members of TaskSchedule and Tasks,
// the keys below `controller.mpc.tasks` and what is asked for at a time are made from this list;
// the kernel (whole_body_cost.cpp, and the problems' shaped wheel torques) is checked against it
// row by row. Further tasks need no row here: see added_task.hpp.
//
//   LED(name, N, unit, term, least, words)   with a reference over time
//   HELD(name, N, unit, term, least, words)  against zero, or the rate of another's reference
//
// N components of a residual in `unit`; `term` of the cost under which it is recorded; `least`
// weight, above zero where the task must be there.
#define BALLBOT_TASKS(LED, HELD)                                                              \
  LED(ee_position, 3, "m", kEndEffectorPositionCost, 0,                                       \
      "place of the end-effector in the world, x, y and z")                                   \
  LED(ee_orientation, 3, "", kEndEffectorOrientationCost, 0,                                  \
      "orientation of the end-effector; the error is the sine of half the angle about the "   \
      "world's axes, the reference yaw, pitch, roll")                                         \
  HELD(ee_velocity, 3, "m/s", kEndEffectorTwistCost, 0,                                       \
       "velocity of the end-effector, against its reference's")                               \
  HELD(ee_rate, 3, "rad/s", kEndEffectorTwistCost, 0,                                         \
       "angular velocity of the end-effector, against its reference's")                       \
  LED(ball_position, 2, "m", kBallPositionCost, 0,                                            \
      "place of the ball in the plane, x and y in the world")                                 \
  LED(yaw, 1, "rad", kYawCost, 0, "heading of the base")                                      \
  HELD(ball_velocity, 2, "m/s", kBallVelocityCost, 0,                                         \
       "velocity of the ball, against its reference's")                                       \
  HELD(base_rate, 3, "rad/s", kBaseRateCost, 0,                                               \
       "angular velocity of the base about its own axes, against none")                       \
  LED(arm_position, kArmJointCount, "rad", kArmPositionCost, 0, "angles of the arm's joints") \
  HELD(arm_rate, kArmJointCount, "rad/s", kArmRateCost, 0,                                    \
       "speeds of the arm's joints, against none")                                            \
  HELD(wheel_torque, 1, "N m", kWheelTorqueCost, kTiny,                                       \
       "torques of the wheels, as shaped; they must cost something")                          \
  HELD(arm_torque, 1, "N m", kArmTorqueCost, kTiny,                                           \
       "torques of the arm's joints; they must cost something")                               \
  LED(contact_force, 3, "N", kContactForceCost, 0,                                            \
      "force of the environment on the end-effector in the contact frame, the normal last; "  \
      "without a weight there is no contact")                                                 \
  LED(contact_moment, 3, "N m", kContactMomentCost, 0,                                        \
      "moment of the environment on the end-effector in the contact frame")

namespace ballbot {

/// One number for a task of one component, which has one weight for all of its joints.
template <int N>
struct TaskWeightOf {
  using Type = Eigen::Matrix<double, N, 1>;
  static Type zero() { return Type::Zero(); }
};
template <>
struct TaskWeightOf<1> {
  using Type = double;
  static Type zero() { return 0; }
};

}  // namespace ballbot
