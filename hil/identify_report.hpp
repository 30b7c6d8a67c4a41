#pragma once

#include <string>

#include "hil/identify_drive.hpp"

namespace ballbot {

/// What a fitted response means for a scenario.
struct IdentifiedScenario {
  std::string include;             ///< the scenario that is changed, as the written file names it
  std::string group;               ///< "wheel" or "arm": whose actuators
  double torque_bandwidth_Hz = 0;  ///< for robot.actuators.GROUP
  bool shaping = false;            ///< the controller's MPC has wheel_shaping to be matched
};

/// A scenario file, as YAML with comments: `include` with the actuators' bandwidth and the MPC's
/// frequency shaping laid over it. The shaping's zero lies at 0.4 of the bandwidth and its pole at
/// twice the zero: the ratio of the shipped controller to the shipped 40 Hz drives.
std::string identifiedYaml(const std::string& drive, const Identification& found,
                           const IdentifiedScenario& scenario);

/// Gain and phase over frequency: the measured points and both fits, sampled like the points.
/// @param period of the bus cycle [s]
std::string bodeSvg(const std::string& drive, const Identification& found, double period);

}  // namespace ballbot
