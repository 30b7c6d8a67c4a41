#pragma once

#include <string>

namespace ballbot {

class ConfigNode;

/// What an FMU of the plant is made from.
struct FmuExport {
  int fmi_version = 2;           ///< 2 or 3
  std::string program_version;   ///< of this program
  std::string libraries_folder;  ///< shared objects and licenses, see defaultFmuLibraries()
};

/// Where the build and an installation keep the FMU's shared objects: ../lib/ballbot/fmu, seen from
/// the program.
std::string defaultFmuLibraries();

/// Writes the plant that a scenario describes as an FMU for Co-Simulation: model description,
/// shared objects, resources (resolved scenario and URDF), documentation. Equal scenarios and
/// programs give equal bytes.
/// @param scenario whole tree; its controller and estimator stay behind
/// @param urdf_path of the robot
/// @throw InputError for a bad scenario or version, OutputError where it cannot be written.
void exportFmu(const ConfigNode& scenario, const std::string& urdf_path, const FmuExport& how,
               const std::string& path);

}  // namespace ballbot
