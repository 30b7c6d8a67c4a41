#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "controller/added_task.hpp"
#include "controller/cost_terms.hpp"
#include "controller/governed_commands.hpp"
#include "controller/task_list.hpp"
#include "controller/time_signal.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

class ConfigVisitor;

using AddedTasks = std::vector<std::shared_ptr<const AddedTask>>;

/// What the robot is asked for at one instant: weights of the cost rate
///
///   L = 1/2 sum w_i e_i^2
///
/// (Minniti et al. 2019, eq. 8) and the targets the errors are taken from. Pitch and roll of the
/// base have no task: how the robot leans is left to the plan.
struct Tasks {
  // Weights, per component where the task has components: ee_position_weight [1/m^2], ...
#define BALLBOT_WEIGHT(name, N, unit, term, least, words) \
  TaskWeightOf<N>::Type name##_weight = TaskWeightOf<N>::zero();
  BALLBOT_TASKS(BALLBOT_WEIGHT, BALLBOT_WEIGHT)
#undef BALLBOT_WEIGHT

  // Targets.
  Vector3 p_WE = Vector3::Zero();
  Matrix3 R_WE = Matrix3::Identity();
  Vector3 v_WE_W = Vector3::Zero(), w_WE_W = Vector3::Zero();
  Eigen::Vector2d ball_position = Eigen::Vector2d::Zero();
  Eigen::Vector2d ball_velocity = Eigen::Vector2d::Zero();
  double yaw = 0;
  ArmVector arm_position = ArmVector::Zero();
  ArmVector arm_torque = ArmVector::Zero();  ///< that costs nothing [N m]
  /// Slopes that are taken back: GovernedCommands.
  ArmVector arm_position_wish = ArmVector::Zero(), arm_torque_wish = ArmVector::Zero();
  Vector3 contact_force_C = Vector3::Zero();   ///< on the end-effector [N]
  Vector3 contact_moment_C = Vector3::Zero();  ///< on the end-effector, at E [N m]
  Matrix3 R_WC = Matrix3::Identity();          ///< contact frame, z_C: normal pointing to the robot

  /// Beside these: none where it is null.
  const AddedTasks* added = nullptr;
  std::array<TaskTarget, kMaxAddedTasks> added_target;

  /// The plan may push on the environment.
  bool inContact() const { return !contact_force_weight.isZero(0); }
  /// ... and twist on it.
  bool withMoments() const { return inContact() && !contact_moment_weight.isZero(0); }
};

/// What a plan has to know about the contact beyond the schedule.
struct ContactSituation {
  bool lost = false;  ///< there is nothing to push against: contact tasks are off
  double turn = 0;    ///< of the contact frame about the vertical, on top of the schedule's [rad]
  double force_limit = std::numeric_limits<double>::infinity();  ///< on the normal force asked [N]
  double force_added = 0;  ///< to the normal force asked, after the limit [N]
};

/// The tasks over time: each with a weight that may change at given times and a reference made of
/// steps, ramps and circles. References start from the pose of the robot at rest at the origin.
class TaskSchedule {
 public:
  /// @param robot  its equilibrium at the nominal arm pose gives the initial references
  explicit TaskSchedule(const RobotParameters& robot);

  /// As in docs/theory/mpc.md.
  void describe(ConfigVisitor& v);

  /// Tasks at time t [s] as known at `now` <= t, see TimeSignal::value. Free of allocation.
  /// @param commands  what a plan that starts at `now` takes of them
  void at(double t, double now, Tasks& out, const ContactSituation& contact = {},
          const GovernedCommands& commands = {}) const;

  /// How far a door on `contact_hinge` has turned when the end-effector touches it at p_WE, less
  /// than a quarter turn to either side [rad]; 0 without a hinge.
  double turnAboutHinge(const Vector3& p_WE) const;

  /// Whether plans know of steps and switched weights before they come. Off: they are commands.
  bool preview = false;

  // ee_position_weight and ee_position, ..., the references in the units of their residuals but
  // for orientations: yaw, pitch, roll of E in W [rad].
#define BALLBOT_LED(name, N, unit, term, least, words) \
  TimedWeight<N> name##_weight;                        \
  TimeSignal<N> name;  // NOLINT(bugprone-macro-parentheses): a member's name
#define BALLBOT_HELD(name, N, unit, term, least, words) TimedWeight<N> name##_weight;
  BALLBOT_TASKS(BALLBOT_LED, BALLBOT_HELD)
#undef BALLBOT_LED
#undef BALLBOT_HELD

  TimeSignal<1> contact_turn;  ///< of the contact frame about the vertical [rad]

  AddedTasks added;  ///< at most kMaxAddedTasks

  Vector3 contact_normal_W = -Vector3::UnitX();  ///< unit, pointing to the robot, before any turn
  std::optional<Eigen::Vector2d> contact_hinge;  ///< vertical axis the touched surface turns on [m]

 private:
  void describeAdded(ConfigVisitor& v);

  RobotParameters robot_;
  StateVector rest_;
};

/// Contact frame whose z axis is `normal`; x is horizontal.
Matrix3 contactFrame(const Vector3& normal);

}  // namespace ballbot
