#pragma once

#include <string>

#include "report/report_data.hpp"

namespace ballbot {

/// Finds what would make a page that lies or does not draw.
/// @throw InputError naming the series, body or phase: lengths differ, times do not ascend, a
///        colour channel or phase is out of range, the replay has no URDF or no followed link
void checkReportData(const ReportData& data, const std::string& urdf_text);

}  // namespace ballbot
