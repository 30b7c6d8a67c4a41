#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosim/log_reader.hpp"
#include "experiment/log_tables.hpp"
#include "experiment/run_config.hpp"
#include "metrics/estimation_errors.hpp"

namespace ballbot {

/// What an estimator makes of recorded sensors.
struct LogEstimate {
  std::vector<EstimateFrame> estimates;
  /// Under their documented names (docs/metrics.md): errors where the log holds the truth, the
  /// filter's own statistics, and rejections.
  std::map<std::string, double> metrics;
  /// Truth less estimate, biases, innovations and rejections over time; without truth the first of
  /// these are not a number.
  LogTable errors;
  bool has_truth = false;
  std::size_t compared = 0;  ///< recorded estimates that were compared with the new ones
  std::optional<SimTime> first_difference;  ///< of one bit

  bool identical() const { return compared > 0 && !first_difference; }
};

/// Plays the sensor frames of a log to the scenario's estimator as the controller process does: one
/// frame per period of the estimator, at rest until the release. The truth is met by the metrics
/// only. With the settings of the run and a log that holds every frame the estimator saw, the
/// result is that of the run bit for bit.
/// @throw InputError if the log holds no sensor frames, or the scenario's estimator is not right.
LogEstimate estimateLog(const RunConfig& config, const RunLog& log);

}  // namespace ballbot
