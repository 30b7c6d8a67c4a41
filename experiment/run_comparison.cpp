#include "experiment/run_comparison.hpp"

#include "experiment/recorded_run.hpp"

namespace ballbot {
namespace {

std::string otherSummary(const RecordedSummary& a, const RecordedSummary& b) {
  for (const auto& [name, value] : a.facts) {
    const auto it = b.facts.find(name);
    if (it == b.facts.end() || it->second != value) {
      return "the logs are identical, '" + name + "' in summary.json differs";
    }
  }
  return a.facts.size() == b.facts.size() ? "" : "the logs are identical, summary.json differs";
}

}  // namespace

RunComparison compareRuns(const RunFolder& a, const RunFolder& b) {
  for (const RunFolder* run : {&a, &b}) {
    requireUnedited(*run);
    requireWholeLog(*run);
  }
  RunComparison out;
  out.difference = compareLogs(a.logFile(), b.logFile(), RunBegin::kMayBeLater);
  const auto summary_a = readSummary(a), summary_b = readSummary(b);
  for (const auto& [run, summary] : {std::pair(&a, &summary_a), std::pair(&b, &summary_b)}) {
    if (!*summary) {
      out.notes.push_back(run->path() +
                          ": was interrupted (there is no summary.json), so it has no metrics");
    }
  }
  if (!summary_a || !summary_b) return out;
  for (const auto& [name, value] : summary_a->metrics) {
    const auto it = summary_b->metrics.find(name);
    if (it != summary_b->metrics.end()) out.metrics[name] = {value, it->second};
  }
  // A run that continues another judges its own part alone.
  const bool same_begin = readManifest(a).begins_at_s == readManifest(b).begins_at_s;
  if (!out.difference && same_begin) out.other_summary = otherSummary(*summary_a, *summary_b);
  return out;
}

}  // namespace ballbot
