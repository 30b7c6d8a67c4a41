#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosim/log_compare.hpp"
#include "experiment/run_folder.hpp"

namespace ballbot {

/// What two run folders say about each other.
struct RunComparison {
  /// The first difference of the logs.
  std::optional<RunDifference> difference;
  /// Where runs with equal logs and the same beginning were judged differently, in words.
  std::string other_summary;
  /// "runs/x: was interrupted, so it has no metrics"
  std::vector<std::string> notes;
  /// Metrics that both have.
  std::map<std::string, std::pair<double, double>> metrics;

  bool identical() const { return !difference && other_summary.empty(); }
  std::string text() const {
    return difference ? difference->text : other_summary.empty() ? "identical" : other_summary;
  }
};

/// Compares two runs, of which one may continue the other or be interrupted; all of both must be as
/// they were left. @throw InputError saying which file is damaged, edited or missing, and where
RunComparison compareRuns(const RunFolder& a, const RunFolder& b);

}  // namespace ballbot
