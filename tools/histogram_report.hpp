#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "hil/jitter_histogram.hpp"

namespace ballbot {

/// A histogram of times as numbers: `count`, `p50_us`, `p99_us`, `p999_us`, `max_us`, and its rows.
nlohmann::ordered_json histogramJson(const JitterHistogram& histogram);

/// The same for people: a line of percentiles, then a bar for each row. @param json  as it gave it
std::string histogramText(const std::string& what, const nlohmann::ordered_json& json);

/// One line of a table of percentiles, and its head.
std::string percentilesRow(const std::string& what, const nlohmann::ordered_json& json);
std::string percentilesHead(const std::string& what);

}  // namespace ballbot
