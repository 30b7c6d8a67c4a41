#include "controller/reference_limits.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

std::string jointName(const RobotParameters& robot, int joint) {
  return joint < kWheelCount ? fmt::format("wheel {}", joint + 1)
                             : fmt::format("'{}'", robot.arm[joint - kWheelCount].name);
}

/// "FILE:LINE:COLUMN: arm_position asks at 2 s".
std::string asksAt(const ConfigReader& tasks, const char* task, double t) {
  return fmt::format("{} asks at {:g} s", tasks.at(task), t);
}

void requireArm(const TaskSchedule& schedule, const Constraints& c, const RobotParameters& robot,
                const ConfigReader& tasks) {
  for (const double t : schedule.arm_position.turningTimes()) {
    const ArmVector arm = schedule.arm_position.value(t);
    for (int i = 0; i < kArmJointCount; ++i) {
      const ArmLink& joint = robot.arm[i];  // a pose nearer than the plan's margin is approached
      if (arm[i] >= joint.lower_limit && arm[i] <= joint.upper_limit) continue;
      throw InputError(
          fmt::format("{} for {:.4g} rad of joint {} ('{}'), must be between {} and {}",
                      asksAt(tasks, "arm_position", t), arm[i], i + 1, joint.name,
                      joint.lower_limit, joint.upper_limit));
    }
    requireStaticTorque(robot, arm, c.torque_limit,
                        fmt::format("{} at {:g} s", tasks.at("arm_position"), t));
  }
}

void requirePush(const TaskSchedule& schedule, const Constraints& c, const ConfigReader& tasks) {
  for (const double t : schedule.contact_force.turningTimes()) {
    const Vector3 force = schedule.contact_force.value(t);
    if (force.z() < 0) {
      throw InputError(
          fmt::format("{} for {:.4g} N along the normal, must be at least 0: the "
                      "end-effector can push, it cannot pull",
                      asksAt(tasks, "contact_force", t), force.z()));
    }
    const double across = force.head<2>().norm(), most = c.friction * force.z();
    if (across > most) {
      throw InputError(fmt::format(
          "{} for {:.4g} N across the normal, must be at most {:.4g}: {:g} (the friction_cone's) "
          "times the {:.4g} N along it, or it slides",
          asksAt(tasks, "contact_force", t), across, most, c.friction, force.z()));
    }
  }
}

}  // namespace

void requireStaticTorque(const RobotParameters& robot, const ArmVector& arm,
                         const JointVector& torque_limit, const std::string& where) {
  const JointVector tau = findEquilibrium(ReducedDynamics(robot), arm).tau;
  for (int j = 0; j < kJointCount; ++j) {
    if (std::abs(tau[j]) < torque_limit[j]) continue;
    throw InputError(fmt::format(
        "{}: to stand still with the arm at ({:.4g}) rad {} needs {:.4g} N m, must be less than "
        "its "
        "torque limit of {:g} N m",
        where, fmt::join(arm, ", "), jointName(robot, j), std::abs(tau[j]), torque_limit[j]));
  }
}

void requireWithinLimits(const TaskSchedule& schedule, const Constraints& constraints,
                         const RobotParameters& robot, const ConfigReader& tasks) {
  requireArm(schedule, constraints, robot, tasks);
  requirePush(schedule, constraints, tasks);
}

}  // namespace ballbot
