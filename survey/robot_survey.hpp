#pragma once

#include <string>
#include <vector>

#include "survey/leaning.hpp"
#include "survey/workspace.hpp"

namespace ballbot {

/// What a robot is and what physics lets it do, from its parameters alone: no law, no drives but
/// their limits.
struct RobotSurvey {
  double mass = 0;          ///< of all [kg]
  double mass_on_ball = 0;  ///< [kg]
  // At rest in the nominal pose:
  double height = 0;           ///< of the centre of mass of that, above the ball's centre [m]
  double pitch = 0, roll = 0;  ///< at which it stands [rad]
  ArmVector arm_torque = ArmVector::Zero();  ///< that holds the arm there [N m]
  double fall_rate = 0;                      ///< fastest unstable pole there, arm held [1/s]

  Workspace workspace;
  std::vector<Lean> leans;  ///< along the worst of twelve headings each: most torque

  /// The steepest lean that the wheels' torque can hold, 25 degrees at most, and what it gives.
  Lean steepest;
  double top_speed = 0;         ///< [m/s]; kUnlimited for wheels of any speed
  double braking_distance = 0;  ///< from there at the steepest lean [m]; kUnlimited
  double metre_s = 0;           ///< least time of a step of 1 m from rest to rest [s]

  /// At which the loop gain has to be 1 at least (docs/theory/loop.md), and what a torque loop of
  /// second order needs to lag less than 20 degrees there.
  double least_crossover = 0;     ///< [rad/s]
  double least_bandwidth_Hz = 0;  ///< of the drives

  /// What keeps this robot from standing or reaching as its description has it, a sentence each.
  std::vector<std::string> warnings;
};

/// @throw NumericalError if it cannot stand in its nominal pose.
RobotSurvey surveyRobot(const RobotParameters& robot);

}  // namespace ballbot
