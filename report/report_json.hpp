#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "report/write_report.hpp"

namespace ballbot {

/// The data as the page reads them (viewer/src/data/format.ts says the same in TypeScript). Times
/// are listed once in "times", as a start, step and count where they are evenly spaced, and
/// referred to by index; columns of numbers are base64 of 32-bit floats.
nlohmann::ordered_json reportJson(const ReportData& data, const std::string& urdf_text,
                                  const ReportSize& size);

}  // namespace ballbot
