#pragma once

#include <limits>
#include <optional>

#include "controller/governed_commands.hpp"
#include "controller/time_signal.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

class ConfigVisitor;

/// What the robot is asked for at one instant: weights of the cost rate
///
///   L = 1/2 sum w_i e_i^2
///
/// (Minniti et al. 2019, eq. 8) and the targets the errors are taken from. Pitch and roll of the
/// base have no task: how the robot leans is left to the plan.
struct Tasks {
  // Weights, per component where the task has components.
  Vector3 ee_position_weight = Vector3::Zero();     ///< in W [1/m^2]
  Vector3 ee_orientation_weight = Vector3::Zero();  ///< of sin(angle/2) about the axes of W
  Vector3 ee_velocity_weight = Vector3::Zero();     ///< in W [s^2/m^2]
  Vector3 ee_rate_weight = Vector3::Zero();         ///< angular, in W [s^2/rad^2]
  Eigen::Vector2d ball_position_weight = Eigen::Vector2d::Zero();  ///< in W [1/m^2]
  double yaw_weight = 0;                                           ///< [1/rad^2]
  Eigen::Vector2d ball_velocity_weight = Eigen::Vector2d::Zero();  ///< in W [s^2/m^2]
  Vector3 base_rate_weight = Vector3::Zero();                      ///< of w_WB_B [s^2/rad^2]
  Vector3 arm_position_weight = Vector3::Zero();                   ///< [1/rad^2]
  Vector3 arm_rate_weight = Vector3::Zero();                       ///< [s^2/rad^2]
  double wheel_torque_weight = 0;                   ///< of the shaped torque [1/(N m)^2]
  double arm_torque_weight = 0;                     ///< [1/(N m)^2]
  Vector3 contact_force_weight = Vector3::Zero();   ///< in C [1/N^2]; all zero: no contact
  Vector3 contact_moment_weight = Vector3::Zero();  ///< in C [1/(N m)^2]; all zero: no moments

  // Targets.
  Vector3 p_WE = Vector3::Zero();
  Matrix3 R_WE = Matrix3::Identity();
  Vector3 v_WE_W = Vector3::Zero(), w_WE_W = Vector3::Zero();
  Eigen::Vector2d ball_position = Eigen::Vector2d::Zero();
  Eigen::Vector2d ball_velocity = Eigen::Vector2d::Zero();
  double yaw = 0;
  Vector3 arm_position = Vector3::Zero();
  Vector3 contact_force_C = Vector3::Zero();   ///< on the end-effector [N]
  Vector3 contact_moment_C = Vector3::Zero();  ///< on the end-effector, at E [N m]
  Matrix3 R_WC = Matrix3::Identity();          ///< contact frame, z_C: normal pointing to the robot

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

  TimedWeight<3> ee_position_weight, ee_orientation_weight, ee_velocity_weight, ee_rate_weight;
  TimedWeight<2> ball_position_weight, ball_velocity_weight;
  TimedWeight<1> yaw_weight;
  TimedWeight<3> base_rate_weight, arm_position_weight, arm_rate_weight;
  TimedWeight<1> wheel_torque_weight, arm_torque_weight;
  TimedWeight<3> contact_force_weight, contact_moment_weight;

  TimeSignal<3> ee_position;     ///< p_WE [m]
  TimeSignal<3> ee_orientation;  ///< yaw, pitch, roll of E in W [rad]
  TimeSignal<2> ball_position;   ///< [m]
  TimeSignal<1> yaw;             ///< [rad]
  TimeSignal<3> arm_position;    ///< [rad]
  TimeSignal<3> contact_force;   ///< in C [N]
  TimeSignal<3> contact_moment;  ///< in C [N m]
  TimeSignal<1> contact_turn;    ///< of the contact frame about the vertical [rad]

  Vector3 contact_normal_W = -Vector3::UnitX();  ///< unit, pointing to the robot, before any turn
  std::optional<Eigen::Vector2d> contact_hinge;  ///< vertical axis the touched surface turns on [m]
};

/// Contact frame whose z axis is `normal`; x is horizontal.
Matrix3 contactFrame(const Vector3& normal);

}  // namespace ballbot
