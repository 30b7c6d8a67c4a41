#pragma once

#include <map>
#include <optional>
#include <string>

#include "cosim/log_reader.hpp"
#include "experiment/run_folder.hpp"

namespace ballbot {

// Reading a run folder back. Each says in words, with the file's name, what is not as the run left
// it.

/// What manifest.json says. @throw InputError
struct RecordedManifest {
  std::string config_digest;
  std::optional<double> begins_at_s;         ///< of a run that continues another
  std::map<std::string, std::string> build;  ///< see buildInfo()
};
RecordedManifest readManifest(const RunFolder& run);

/// What summary.json says; an interrupted run has none.
struct RecordedSummary {
  std::string text;  ///< of the file
  double simulated_s = 0;
  std::string log_digest;
  std::map<std::string, double> metrics;  ///< NaN where a number was none
  /// What happened, beside what was asked for: the members that decide whether two runs were the
  /// same.
  std::map<std::string, std::string> facts;
};
/// @throw InputError
std::optional<RecordedSummary> readSummary(const RunFolder& run);

/// What of the build that made a run is not as in this one, in words; empty: nothing.
std::string buildDifference(const RecordedManifest& manifest);

/// @throw InputError if scenario.yaml, robot.urdf or an FMU is not as it was run.
void requireUnedited(const RunFolder& run);

/// @throw InputError if the log is not as the run left it, with where. Of an interrupted run, what
///        there is must be undamaged.
void requireWholeLog(const RunFolder& run);

/// The log of a run, as far as it is readable. What is damaged stands in it, also where nothing
/// but the digest in summary.json shows it. @throw InputError
RunLog readRecordedLog(const RunFolder& run);

}  // namespace ballbot
