#pragma once

#include <string>

#include "experiment/run_experiment.hpp"

namespace ballbot {

/// The short table that ends a run: verdict, requirements, digest, where the report is.
std::string resultTable(const Scenario& scenario, const RunResult& result);

}  // namespace ballbot
