#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "studies/case_result.hpp"

namespace ballbot {

/// A metric over the runs that have it.
struct MetricRange {
  double least = 0, median = 0, largest = 0;
  int count = 0;
};

/// What became of one scenario with seeds 1 to N.
struct SeedSpread {
  std::vector<CaseResult> by_seed;  ///< that of seed 1 first

  int passed() const;
  std::map<std::string, MetricRange> metrics() const;
  /// A line for each seed that did not pass: "seed 9: ee_pitch_rise_s is 1.89, must be < 1.6".
  std::vector<std::string> missed() const;
};

struct SeedSpreadOptions {
  int seeds = 1;
  int jobs = 1;         ///< runs at once, each in a process of its own
  std::string scratch;  ///< folder for run folders, which are removed again
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done, std::size_t count)> progress;
};

/// Runs each scenario file with every seed, in process and without a log.
/// The calling process must have no other thread.
/// @return one spread for each file
/// @throw InputError for a scenario that cannot be read, InterruptedError, OutputError
std::vector<SeedSpread> runSeeds(const std::vector<std::string>& scenario_files,
                                 const std::vector<std::string>& overrides,
                                 const SeedSpreadOptions& options);

}  // namespace ballbot
