#pragma once

#include "experiment/scenario.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

/// The robot of a scenario, empty-handed. @throw InputError with file, line and column.
RobotParameters scenarioRobot(const Scenario& scenario);

/// The robot as the controller has it: with the payload it believes it carries
/// (`controller.known_payload_kg`); what it does carry stands in `environment`.
/// @throw InputError with file, line and column.
RobotParameters believedRobot(const Scenario& scenario);

}  // namespace ballbot
