#pragma once

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace ballbot {

/// Each verb of the program adds itself here and, when called, leaves its exit code in `result`.
/// Errors are thrown; main() prints them.
void addRunCommand(CLI::App& program, ExitCode& result);
void addCheckCommand(CLI::App& program, ExitCode& result);
void addCompareCommand(CLI::App& program, ExitCode& result);
void addPlantCommand(CLI::App& program, ExitCode& result);
void addControllerCommand(CLI::App& program, ExitCode& result);
void addRelayCommand(CLI::App& program, ExitCode& result);
void addExplainCommand(CLI::App& program, ExitCode& result);
void addExportCommand(CLI::App& program, ExitCode& result);
void addEstimateCommand(CLI::App& program, ExitCode& result);
void addReproduceCommand(CLI::App& program, ExitCode& result);
void addBodeCommand(CLI::App& program, ExitCode& result);
void addViewCommand(CLI::App& program, ExitCode& result);
void addDrivesCommand(CLI::App& program, ExitCode& result);
void addHilCommand(CLI::App& program, ExitCode& result);
void addIdentifyCommand(CLI::App& program, ExitCode& result);
void addFmuCommand(CLI::App& program, ExitCode& result);
void addStudyCommand(CLI::App& program, ExitCode& result);
void addCaptureCommand(CLI::App& program, ExitCode& result);
void addRobotCommand(CLI::App& program, ExitCode& result);
void addDoctorCommand(CLI::App& program, ExitCode& result);

}  // namespace ballbot
