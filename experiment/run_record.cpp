#include "experiment/run_record.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/number_text.hpp"
#include "experiment/build_info.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/sealed_json.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

/// The value below which the share `p` of the (sorted) samples lie [us].
double percentileUs(const std::vector<std::int64_t>& sorted_ns, double p) {
  const auto last = static_cast<double>(sorted_ns.size() - 1);
  return 1e-3 * static_cast<double>(sorted_ns[static_cast<std::size_t>(p * last)]);
}

/// Percentiles over all plans of what `get` takes from each.
template <typename Get>
Json percentilesUs(const std::vector<PlanTiming>& plans, Get get) {
  std::vector<std::int64_t> sorted;
  for (const PlanTiming& plan : plans) sorted.push_back(get(plan));
  std::sort(sorted.begin(), sorted.end());
  return {{"p50", percentileUs(sorted, 0.5)},
          {"p99", percentileUs(sorted, 0.99)},
          {"max", percentileUs(sorted, 1.0)}};
}

}  // namespace

void writeManifest(const Scenario& scenario, const RunFolder& folder,
                   std::optional<SimTime> begins_at) {
  Json m;
  m["scenario"] = scenario.name;
  m["seed"] = scenario.seed;
  m["config_digest"] = scenario.configDigest();
  if (begins_at) m["begins_at_s"] = decimalSeconds(toNs(*begins_at));
  for (const auto& [key, value] : buildInfo()) m["build"][key] = value;
  writeSealedJson(folder.manifestFile(), m);
}

Json summaryJson(const Scenario& scenario, const RunResult& result) {
  Json s;
  s["scenario"] = scenario.name;
  s["passed"] = result.passed;
  s["fell"] = result.fell;
  s["completed"] = result.completed;
  s["no_plan_acted"] = result.no_plan_acted;
  if (!result.plan_trouble.empty()) s["plan_trouble"] = result.plan_trouble;
  s["simulated_s"] = decimalSeconds(toNs(result.end));
  s["trajectory_digest"] = result.trajectory_digest;
  s["log_digest"] = result.log_digest;
  // The two numbers people ask for first stand at the top as well.
  for (const char* name : {"final_ball_position_error_m", "largest_tilt_deg"}) {
    const auto it = result.metrics.find(name);
    if (it != result.metrics.end()) s[name] = it->second;
  }
  s["metrics"] = Json::object();
  const auto rejected = rejectionsAmong(result.metrics);
  for (const auto& [name, value] : result.metrics) {
    if (name.rfind("rejected_", 0) != 0) s["metrics"][name] = value;
  }
  s["rejected"] =
      Json::object();  // what the estimator did not believe; reasons not met are left out
  for (const auto& [reason, count] : rejected) s["rejected"][reason] = count;
  s["requirements"] = Json::array();
  for (const VerdictRow& row : result.verdicts) {
    Json r;
    r["metric"] = row.metric;
    r["limit"] = row.limit;
    r["measured"] = row.measured;
    if (row.measured) r["value"] = row.value;
    r["passed"] = row.passed;
    s["requirements"].push_back(r);
  }
  return s;
}

void writeSummary(const Scenario& scenario, const RunResult& result, const RunFolder& folder) {
  writeSealedJson(folder.summaryFile(), summaryJson(scenario, result));
}

void writeTiming(const RunResult& result, const RemoteParticipant::LinkStatistics& link,
                 const std::vector<PlanTiming>& plan_times, std::int64_t log_bytes,
                 const RunFolder& folder) {
  Json t;
  t["wall_s"] = result.wall_seconds;
  t["real_time_factor"] =
      result.wall_seconds > 0 ? toSeconds(result.end) / result.wall_seconds : 0.0;
  t["requests"] = link.requests;
  t["requests_repeated"] = link.repeated;
  t["log_bytes"] = log_bytes;
  if (!plan_times.empty()) {
    t["plan_us"] = percentilesUs(plan_times, [](const PlanTiming& p) { return p.total_ns; });
    t["plan_phases_us"] = {
        {"approximation",
         percentilesUs(plan_times, [](const PlanTiming& p) { return p.approximation_ns; })},
        {"riccati", percentilesUs(plan_times, [](const PlanTiming& p) { return p.riccati_ns; })},
        {"line_search",
         percentilesUs(plan_times, [](const PlanTiming& p) { return p.line_search_ns; })}};
  }
  writeTextFile(folder.timingFile(), jsonText(t) + "\n");
}

}  // namespace ballbot
