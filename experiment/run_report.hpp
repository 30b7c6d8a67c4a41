#pragma once

#include "experiment/run_experiment.hpp"

namespace ballbot {

/// Writes report.html of a run from what it recorded. @throw OutputError
void writeRunReport(const RunConfig& config, const RunResult& result, const RunFolder& folder);

}  // namespace ballbot
