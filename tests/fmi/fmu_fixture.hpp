#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "core/time.hpp"
#include "fmi/fmu_ports.hpp"

namespace ballbot {

/// Scenario `balance`, released after 20 ms so that the robot moves in short tests.
ConfigNode testScenario();
std::string testUrdf();

/// An FMU of that scenario, exported and unpacked once per process and version.
struct UnpackedFmu {
  std::string file, folder;  ///< the folder has a blank and an umlaut in its name
  FmuDescription description;

  ValueReference reference(const std::string& name) const;
  std::string libraryPath() const { return folder + "/" + description.binaryPath(); }
};
const UnpackedFmu& unpackedFmu(int fmi_version);

/// A command with something for every drive to do, different at every step.
std::vector<double> busyCommand(int step);

/// The words of the Error that `action` throws.
std::string messageOf(const std::function<void()>& action);

}  // namespace ballbot
