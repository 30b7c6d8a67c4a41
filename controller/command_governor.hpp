#pragma once

#include "controller/tasks.hpp"
#include "core/time.hpp"

namespace ballbot {

class ConfigVisitor;

/// What of a command is taken at once, and how fast the rest is approached. The defaults leave the
/// paper's steps alone; a ball that rolls at 0.6 m/s while the base turns leaves the wheels
/// (12 rad/s: 1.09 m/s without a turn) room to balance. An end-effector moves slower, for a ball
/// that is free to follow it overtakes it where the arm has to be drawn in.
struct CommandLimits {
  double step = 0.5;         ///< of ball and end-effector [m]
  double lead = 0.02;        ///< [m]
  double speed = 0.6;        ///< of the ball [m/s]
  double ee_speed = 0.4;     ///< of the end-effector [m/s]
  double angle_step = 0.8;   ///< of headings, orientations and arm joints [rad]
  double angle_lead = 0.05;  ///< [rad]
  double angle_speed = 0.6;  ///< [rad/s]
  double lag = 0.5;          ///< the anchor is no farther from the robot [m]
  double angle_lag = 0.8;    ///< ... [rad]
  double push = 15;          ///< of the end-effector [N]; what gives way to more outruns the robot

  void describe(ConfigVisitor& v);
};

/// Keeps commands within what the robot can be asked for at one time, so that no command makes it
/// fall: places far away are approached at a bounded speed from where the robot is, heights beyond
/// the arm's reach and angles beyond its stops are asked for at the boundary.
class CommandGovernor {
 public:
  CommandGovernor(const RobotParameters& robot, const CommandLimits& limits);

  /// Governs the commands of added tasks as well, as each says of itself. Before all else.
  void governAdded(const AddedTasks& tasks);

  /// Moves on to `now` and to where the robot is.
  void update(SimTime now, const TaskSchedule& schedule, const StateVector& x,
              const ReducedDynamics::EndEffector& tip) noexcept;

  /// For a plan that starts at the time of the last update.
  const GovernedCommands& commands() const noexcept { return commands_; }
  /// Whether at that time a task with weight is asked for more than its plan takes.
  bool cutting() const noexcept { return cutting_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.cutting_);
    visit(self.last_);
    visit(self.commands_.ee_position);
    visit(self.commands_.ee_orientation);
    visit(self.commands_.ball_position);
    visit(self.commands_.yaw);
    visit(self.commands_.arm_position);
    visit(self.commands_.added);
  }

 private:
  void followAdded(const Tasks& asked, double seconds, const StateVector& x) noexcept;

  CommandLimits limits_;
  GovernedCommands commands_;
  bool started_ = false;
  bool cutting_ = false;
  SimTime last_{};
};

}  // namespace ballbot
