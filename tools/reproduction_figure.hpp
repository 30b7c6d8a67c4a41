#pragma once

#include <string>
#include <vector>

#include "experiment/scenario.hpp"

namespace ballbot {

/// The picture of a run for the reproduction page, from what it recorded.
/// @param panels  see PaperExperiment
/// @throw InputError if the log cannot be read.
std::string reproductionFigure(const Scenario& scenario, const std::string& log_file,
                               const std::vector<std::string>& panels);

}  // namespace ballbot
