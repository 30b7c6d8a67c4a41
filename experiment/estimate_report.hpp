#pragma once

#include <string>

#include "experiment/estimate_log.hpp"
#include "experiment/scenario.hpp"

namespace ballbot {

/// What a person wants to see of an estimate: errors between their two-sigma bounds, biases,
/// innovations, and what was rejected when.
/// @param should_be_identical  the settings are those of the run
/// @throw OutputError
void writeEstimateReport(const Scenario& scenario, const LogEstimate& estimate,
                         bool should_be_identical, const std::string& path);

}  // namespace ballbot
