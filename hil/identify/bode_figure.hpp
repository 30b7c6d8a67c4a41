#pragma once

#include <string>

#include "hil/identify/identify.hpp"

namespace ballbot {

/// Gain and phase over frequency (SVG): the points and both fits, sampled like the points.
/// @param period of the bus cycle [s]
std::string bodeSvg(const std::string& drive, const Identification& found, double period);

}  // namespace ballbot
