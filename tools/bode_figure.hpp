#pragma once

#include <complex>
#include <string>

#include "experiment/loop_analysis.hpp"
#include "model/actuator_response.hpp"

namespace ballbot {

/// Size of a gain [dB].
double decibel(std::complex<double> gain);

/// The curves of a loop analysis as an SVG picture: weight, drive, loop gain, distance.
std::string bodeFigure(const std::string& scenario_name, const LoopAnalysis& analysis);

}  // namespace ballbot
