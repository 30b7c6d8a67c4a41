#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "hil/record/fault_record.hpp"

namespace ballbot {

/// What record.json says: run, bench, the check that fired first and all that fired, how the drives
/// went down, and what stretch of time the other files hold.
nlohmann::ordered_json recordJson(const FaultRecord& record);

/// Name of whatever a check speaks of: "wheel 2", "IMU", "".
std::string subjectOf(const Finding& finding, const BenchConfig& config);

}  // namespace ballbot
