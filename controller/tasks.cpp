#include "controller/tasks.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "controller/added_task_check.hpp"
#include "controller/frame_task.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

/// A task: weight, and a reference where there can be one.
template <int N>
void describeTask(ConfigVisitor& v, const ConfigKey& key, TimedWeight<N>& weight,
                  TimeSignal<N>* reference, double least_weight) {
  v.section(key, [&](ConfigVisitor& task) {
    weight.describe(task, least_weight);
    if (!reference) return;
    task.section(may("reference", "what is asked for over time"),
                 [&](ConfigVisitor& signal) { reference->describe(signal); });
  });
}

void weigh(const Eigen::Matrix<double, 1, 1>& weight, double& out) { out = weight[0]; }
template <int N>
void weigh(const Eigen::Matrix<double, N, 1>& weight, Eigen::Matrix<double, N, 1>& out) {
  out = weight;
}

/// Angular velocity in W of R = Rz(yaw) Ry(pitch) Rx(roll) at given angle rates.
Vector3 rateFromYawPitchRoll(const Vector3& angles, const Vector3& rates) {
  const double cz = std::cos(angles[0]), sz = std::sin(angles[0]);
  const double cy = std::cos(angles[1]), sy = std::sin(angles[1]);
  return Vector3::UnitZ() * rates[0] + Vector3(-sz, cz, 0) * rates[1] +
         Vector3(cz * cy, sz * cy, -sy) * rates[2];
}

}  // namespace

TaskSchedule::TaskSchedule(const RobotParameters& robot) : robot_(robot) {
  const ReducedDynamics dynamics(robot);
  rest_ = findEquilibrium(dynamics, robot.nominal_arm).x;
  const ReducedDynamics::EndEffector ee = dynamics.endEffector(rest_);
  ee_position = TimeSignal<3>(ee.p_WE);
  ee_orientation = TimeSignal<3>(yawPitchRollFromRotation(ee.R_WE));
  arm_position = TimeSignal<kArmJointCount>(robot.nominal_arm);
}

void TaskSchedule::describe(ConfigVisitor& v) {
#define BALLBOT_LED(name, N, unit, term, least, words) \
  describeTask<N>(v, {#name, words, least > 0}, name##_weight, &name, least);
#define BALLBOT_HELD(name, N, unit, term, least, words) \
  describeTask<N>(v, {#name, words, least > 0}, name##_weight, nullptr, least);
  BALLBOT_TASKS(BALLBOT_LED, BALLBOT_HELD)
#undef BALLBOT_LED
#undef BALLBOT_HELD
  v.section(may("contact_turn", "angle of the contact frame about the vertical over time"),
            [&](ConfigVisitor& turn) { contact_turn.describe(turn); });
  v.other(may("contact_hinge_m",
              "place in the plane of a door's hinge: the contact frame turns with it"),
          "list of 2 numbers, -1000 to 1000", [&](ConfigReader& in) {
            const auto hinge = in.numbers<2>("contact_hinge_m", {-1e3, 1e3});
            contact_hinge = Eigen::Vector2d(hinge[0], hinge[1]);
          });
  v.other(may("contact_normal",
              "normal of the touched surface, pointing to the robot, before any turn; with a "
              "horizontal part, of any length, by default [-1, 0, 0]"),
          "list of 3 numbers, -1 to 1", [&](ConfigReader& in) {
            const auto n = in.numbers<3>("contact_normal", {-1, 1});
            contact_normal_W << n[0], n[1], n[2];
            const double horizontal = contact_normal_W.head<2>().norm();
            if (horizontal < 0.1) {
              throw InputError(fmt::format("{} is ({}, {}, {}), must have a horizontal part",
                                           in.at("contact_normal"), n[0], n[1], n[2]));
            }
            contact_normal_W.normalize();
          });
  describeAdded(v);
  v.boolean(may("preview", "whether plans see steps and switched weights before they come"),
            preview);
}

void TaskSchedule::describeAdded(ConfigVisitor& v) {
  describeFrameTasks(v, robot_, rest_, added);
  for (const TaskKind& kind : taskKinds().all()) {
    v.section(may(kind.name.c_str(), kind.words.c_str()), [&](ConfigVisitor& in) {
      const std::shared_ptr<AddedTask> task = kind.make(robot_, rest_);
      task->describe(in);
      in.check(
          [&](const ConfigReader& section) { requireFinite(*task, rest_, section.at("weight")); });
      added.push_back(task);
    });
  }
  std::set<std::string> names;
  for (const auto& task : added) {
    if (names.insert(task->name()).second) continue;
    throw InputError(fmt::format("controller.mpc.tasks: two tasks are called '{}'", task->name()));
  }
  if (added.size() > kMaxAddedTasks) {
    throw InputError(
        fmt::format("controller.mpc.tasks: {} tasks on frames or added, at most {} are possible "
                    "(position and orientation count apart)",
                    added.size(), kMaxAddedTasks));
  }
}

void TaskSchedule::at(double t, double now, Tasks& out, const ContactSituation& contact,
                      const GovernedCommands& commands) const {
  const double ahead = t - now;
  const double known = preview ? t : now;
#define BALLBOT_WEIGHT(name, N, unit, term, least, words) \
  weigh(name##_weight.value(t, known), out.name##_weight);
  BALLBOT_TASKS(BALLBOT_WEIGHT, BALLBOT_WEIGHT)
#undef BALLBOT_WEIGHT
  if (contact.lost) {
    out.contact_force_weight.setZero();
    out.contact_moment_weight.setZero();
  }

  const Vector3 angles = ee_orientation.value(t, known), p_WE = ee_position.value(t, known);
  const Matrix3 R_WE = rotationFromYawPitchRoll(angles[0], angles[1], angles[2]);
  const Eigen::Vector2d ball = ball_position.value(t, known);
  out.p_WE = commands.ee_position.reference(p_WE, ahead);
  out.R_WE = commands.ee_orientation.reference(R_WE, ahead);
  out.v_WE_W = commands.ee_position.rate(p_WE, ee_position.rate(t), ahead);
  out.w_WE_W = commands.ee_orientation.rate(
      R_WE, rateFromYawPitchRoll(angles, ee_orientation.rate(t)), ahead);
  out.ball_position = commands.ball_position.reference(ball, ahead);
  out.ball_velocity = commands.ball_position.rate(ball, ball_position.rate(t), ahead);
  out.yaw = commands.yaw.reference(yaw.value(t, known), ahead)[0];
  out.arm_position = commands.arm_position.reference(arm_position.value(t, known), ahead);
  out.contact_force_C = cutTo(commands.push, contact_force.value(t, known));
  double& normal_force = out.contact_force_C.z();
  normal_force = std::min(normal_force, contact.force_limit) + contact.force_added;
  out.contact_moment_C = contact_moment.value(t, known);
  out.added = added.empty() ? nullptr : &added;
  for (std::size_t i = 0; i < added.size(); ++i) {
    TaskTarget& target = out.added_target[i];
    added[i]->at(t, known, target);
    target.reference = commands.added[i].reference(target.reference, ahead);
  }
  const double turn = contact_turn.value(t, known)[0] + contact.turn;
  out.R_WC = Eigen::AngleAxisd(turn, Vector3::UnitZ()) * contactFrame(contact_normal_W);
  // Who pushes does not stand still: there, torques cost what they are, which keeps the arm near.
  const bool stands = !out.inContact();
  out.arm_torque = stands ? commands.arm_rest_torque : ArmVector::Zero();
  out.arm_position_wish = stands ? commands.arm_position_wish : ArmVector::Zero();
  out.arm_torque_wish = stands ? commands.arm_torque_wish : ArmVector::Zero();
}

double TaskSchedule::turnAboutHinge(const Vector3& p_WE) const {
  if (!contact_hinge) return 0;
  const Eigen::Vector2d normal = contact_normal_W.head<2>();
  const Eigen::Vector2d along = p_WE.head<2>() - *contact_hinge;
  Eigen::Vector2d across(-along.y(), along.x());
  if (across.dot(normal) < 0) across = -across;
  return std::atan2(normal.x() * across.y() - normal.y() * across.x(), normal.dot(across));
}

Matrix3 contactFrame(const Vector3& normal) {
  Matrix3 R_WC;
  R_WC.col(2) = normal;
  R_WC.col(0) = Vector3::UnitZ().cross(normal).normalized();
  R_WC.col(1) = normal.cross(R_WC.col(0));
  return R_WC;
}

}  // namespace ballbot
