#pragma once

#include <string>

#include "hil/identify/identify.hpp"
#include "model/actuator_parameters.hpp"

namespace ballbot {

/// What the figures are compared with and written into.
struct Configured {
  ActuatorParameters actuator;                               ///< of the scenario
  double drive_period = 0.4e-3;                              ///< tick of the scenario's drives [s]
  int transport_delay_ticks = 0;                             ///< of the scenario
  double torque_delay = 0;                                   ///< of the bench file's drive [s]
  double torque_frequency_Hz = 0, torque_damping_ratio = 0;  ///< likewise
};

/// The scenario's actuator with what was identified in the place of what was configured. Static
/// friction stays as far above Coulomb friction as it was.
/// @throw NumericalError if no drive of this motor and spring has the bandwidth found
ActuatorParameters identifiedActuator(const Identification& found, const Configured& configured);

/// How a figure compares with what is configured.
struct Verdict {
  bool has_configured = false;
  double configured = 0;
  std::string text;  ///< "agrees", "differs", "not identified: ..."
};
/// Agrees within two sigma or 5 %.
Verdict verdictOf(const Figure& figure, const Configured& configured);

/// What a written scenario needs to know beside the figures.
struct ScenarioNames {
  std::string drive;          ///< "wheel 1"
  std::string include;        ///< the scenario that is changed, as the written file names it
  std::string group;          ///< "wheel" or "arm": whose actuators
  std::string actuator_file;  ///< that holds the actuator, as the scenario names it; "": inline
  bool shaping = false;       ///< the controller's MPC has wheel_shaping to be matched
};

/// A scenario: `include` with the identified actuator, the plant's transport delay and the MPC's
/// frequency shaping laid over it. The shaping's zero lies at 0.4 of the bandwidth and its pole at
/// twice the zero: the ratio of the shipped controller to the shipped 40 Hz drives.
std::string scenarioYaml(const Identification& found, const Configured& configured,
                         const ScenarioNames& names);

/// The actuator as a file of its own, for `robot.actuators.wheel: {include: FILE}`.
std::string actuatorYaml(const Identification& found, const Configured& configured,
                         const std::string& drive);

/// Figures with their standard deviations, as comments of what is written.
std::string figureComments(const Identification& found, const std::string& drive);

}  // namespace ballbot
