#include "studies/case_run.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <time.h>

#include "experiment/run_experiment.hpp"
#include "experiment/scenario_variants.hpp"

namespace ballbot {
namespace {

/// Of this process [s].
double processorSeconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string whyNotPassed(const RunResult& run) {
  if (run.fell) return "fell at " + toText(run.end);
  for (const VerdictRow& row : run.verdicts) {
    if (row.passed) continue;
    return row.measured ? fmt::format("{} is {:.4g}, must be {}", row.metric, row.value, row.limit)
                        : fmt::format("{} was not measured, must be {}", row.metric, row.limit);
  }
  return "";
}

}  // namespace

CaseResult runCase(const ConfigNode& scenario_tree, const StudyCase& c, const std::string& folder,
                   bool keep) {
  CaseResult result;
  result.id = c.id;
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);  // what a killed attempt left
  try {
    Scenario scenario = readScenario(scenario_tree, c.overrides, c.seed);
    RunOptions options;
    options.in_process = true;
    if (!keep) recordNothing(scenario);
    options.write_report = keep;
    const double started_s = processorSeconds();
    const RunResult run = runExperiment(scenario, folder, options);
    result.cpu_s = processorSeconds() - started_s;
    result.outcome = run.passed ? CaseOutcome::kPassed
                     : run.fell ? CaseOutcome::kFell
                                : CaseOutcome::kMissed;
    result.reason = whyNotPassed(run);
    result.simulated_s = toSeconds(run.end);
    result.metrics = run.metrics;
    result.trajectory_digest = run.trajectory_digest;
  } catch (const OutputError&) {
    throw;  // the disk is at fault, not the case
  } catch (const Error& e) {
    result.outcome = CaseOutcome::kError;
    result.reason = e.what();
  }
  if (!keep) std::filesystem::remove_all(folder, ignored);
  return result;
}

}  // namespace ballbot
