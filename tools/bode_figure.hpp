#pragma once

#include <cmath>
#include <complex>
#include <string>

#include "core/angle.hpp"
#include "experiment/loop_analysis.hpp"
#include "model/actuator_response.hpp"

namespace ballbot {

// What people read instead of rad/s, sizes and radians.
inline double inHertz(double omega) { return omega / kTwoPi; }
inline double inDecibel(std::complex<double> z) { return 20 * std::log10(std::abs(z)); }
inline double phaseDegrees(std::complex<double> z) { return kDegPerRad * std::arg(z); }

/// The curves of a loop analysis as an SVG picture: weight, drive, loop gain, distance.
std::string bodeFigure(const std::string& scenario_name, const LoopAnalysis& analysis);

}  // namespace ballbot
