#include "tools/result_table.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/key_unit.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/run_metrics.hpp"
#include "metrics/limit_margins.hpp"

namespace ballbot {
namespace {

/// Why nothing was measured, where that is known.
std::string missingText(const Scenario& scenario, const RunResult& result) {
  if (result.end > scenario.release) return "";
  return fmt::format(
      "  nothing was judged: the stand held the robot until {}, and the run ended at {}\n",
      toText(scenario.release), toText(result.end));
}

/// Limits that the robot went beyond.
std::string marginText(const RunResult& result) {
  std::string out;
  for (const std::string& name : LimitMargins::names()) {
    const auto margin = result.metrics.find(name);
    if (margin == result.metrics.end() || margin->second >= 0) continue;
    out += fmt::format("  {:<32} {:>12.4g} {:<6} beyond the limit\n", name, margin->second,
                       unitOfKey(name));
  }
  return out;
}

}  // namespace

std::string resultTable(const Scenario& scenario, const RunResult& result) {
  std::string out = fmt::format("{}: {}\n", scenario.name, result.passed ? "passed" : "MISSED");
  if (result.fell) {
    out += fmt::format("  the robot fell at {}; see docs/troubleshooting/robot-falls.md\n",
                       toText(result.end));
  }
  if (!result.verdicts.empty()) {
    out += fmt::format("  {:<32} {:>12} {:<6} {:<12}\n", "requirement", "value", "", "limit");
  }
  for (const VerdictRow& row : result.verdicts) {
    out += fmt::format("  {:<32} {:>12} {:<6} {:<12} {}\n", row.metric,
                       row.measured ? fmt::format("{:.4g}", row.value) : "not measured",
                       row.measured ? unitOfKey(row.metric) : "", row.limit,
                       row.passed ? "ok" : "MISSED");
  }
  out += missingText(scenario, result) + marginText(result);
  const auto rejected = rejectionsAmong(result.metrics);
  if (!rejected.empty()) {
    out += fmt::format("  {:<32} {}\n", "rejected by the estimator", rejectionText(rejected));
  }
  const auto refused = result.metrics.find("plans_refused");
  if (refused != result.metrics.end() && refused->second > 0) {
    out += fmt::format("  {:<32} {:.0f} of {:.0f}; see docs/troubleshooting/plans-refused.md\n",
                       "plans refused", refused->second, result.metrics.at("plans"));
    if (!result.plan_trouble.empty()) out += fmt::format("  {:<32} {}\n", "", result.plan_trouble);
  }
  const auto fallback = result.metrics.find(kFallbackPercent);
  if (fallback != result.metrics.end() && fallback->second > 0) {
    out +=
        fmt::format("  {:<32} {:.4g} % of the time{}; see docs/troubleshooting/plans-refused.md\n",
                    "the LQR stood in for the MPC", fallback->second,
                    result.no_plan_acted ? ": no plan ever acted" : "");
  }
  out += fmt::format("  {:<32} {}\n", "trajectory digest", result.trajectory_digest);
  out += fmt::format("  {:<32} {:.2f} s in {:.2f} s, {:.2f} times real time\n", "simulated",
                     toSeconds(result.end), result.wall_seconds,
                     result.wall_seconds > 0 ? toSeconds(result.end) / result.wall_seconds : 0.0);
  out += fmt::format("  {:<32} {}\n", "run folder", result.folder.path());
  if (std::filesystem::exists(result.folder.reportFile())) {
    out += fmt::format("  {:<32} {}\n", "report", result.folder.reportFile());
  }
  return out;
}

}  // namespace ballbot
