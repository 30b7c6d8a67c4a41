#pragma once

#include <string>

#include "hil/identify_drive.hpp"

namespace ballbot {

/// Values for a robot's actuators and a controller's frequency shaping, as YAML with comments. The
/// shaping's zero lies at 0.4 of the drive's natural frequency and its pole at twice the zero: the
/// ratio of the shipped controller to the shipped 40 Hz drives.
std::string identifiedYaml(const std::string& drive, const Identification& found);

/// Gain and phase over frequency: the measured points and both fits, sampled like the points.
/// @param period of the bus cycle [s]
std::string bodeSvg(const std::string& drive, const Identification& found, double period);

}  // namespace ballbot
