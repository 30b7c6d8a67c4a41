#pragma once

#include <optional>
#include <vector>

#include "cosim/log_reader.hpp"
#include "model/robot_parameters.hpp"
#include "plant/surroundings.hpp"
#include "report/report_data.hpp"

namespace ballbot {

/// Stretches of time in which the end-effector touched something; gaps below 0.1 s are bridged.
std::vector<ReportPhase> contactPhases(const RunLog& log);

/// Force asked for, true and sensed; lean against static balance; the door. Nothing if no force was
/// asked for and nothing touched.
std::optional<PlotGroup> contactGroup(const RunLog& log, const RobotParameters& robot,
                                      const SurroundingsParameters& surroundings);

/// Wall and door as they stood and swung, one pose per recorded truth.
std::vector<ReplayObject> replayObjects(const RunLog& log,
                                        const SurroundingsParameters& surroundings);

}  // namespace ballbot
