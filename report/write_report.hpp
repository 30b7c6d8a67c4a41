#pragma once

#include <cstddef>
#include <string>

#include "report/report_data.hpp"

namespace ballbot {

/// How much of a run goes into its page. The defaults keep the page of a 10 s run with 60 series
/// at 400 Hz near 2 MB.
struct ReportSize {
  /// Longer series are thinned to about this many samples; each sample kept is one of the run, and
  /// the extremes of every stretch are among them.
  std::size_t samples_per_series = 5000;
  double replay_rate_Hz = 60;  ///< a replay recorded faster is thinned to this
};

/// Writes the run's page: one HTML file that needs no network and no file beside it. The same data
/// give the same bytes.
/// @param urdf_text  the robot of `data.replay`; may be empty if there is none
/// @throw InputError  if the data contradict themselves: lengths differ, times do not ascend
/// @throw OutputError if the file cannot be written
void writeReport(const ReportData& data, const std::string& urdf_text, const std::string& path,
                 const ReportSize& size = {});

/// The same page as text.
std::string reportPage(const ReportData& data, const std::string& urdf_text,
                       const ReportSize& size = {});

}  // namespace ballbot
