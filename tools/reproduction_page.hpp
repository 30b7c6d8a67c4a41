#pragma once

#include <string>
#include <vector>

#include "tools/paper_experiments.hpp"
#include "tools/seed_spread.hpp"

namespace ballbot {

/// One experiment that was run, ready to be shown.
struct ReproducedExperiment {
  const PaperExperiment* experiment = nullptr;
  const RunResult* result = nullptr;
  std::string figure;       ///< SVG
  std::string report_link;  ///< relative to the page
  SeedSpread spread;        ///< empty where one seed was enough
};

/// One page that opens offline: a table of verdicts, then per experiment what the paper shows
/// beside what came out, with its picture and a link to its report.
std::string reproductionPage(const std::vector<ReproducedExperiment>& experiments,
                             const std::vector<Comparison>& comparisons);

}  // namespace ballbot
