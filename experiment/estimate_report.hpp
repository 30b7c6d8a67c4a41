#pragma once

#include <string>

#include "experiment/estimate_log.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// What a person wants to see of an estimate: errors between their two-sigma bounds, biases,
/// innovations, and what was rejected when.
/// @param should_be_identical  the settings are those of the run
/// @throw OutputError
void writeEstimateReport(const RunConfig& config, const LogEstimate& estimate,
                         bool should_be_identical, const std::string& path);

}  // namespace ballbot
