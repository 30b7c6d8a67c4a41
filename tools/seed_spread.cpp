#include "tools/seed_spread.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiment/scenario_variants.hpp"
#include "studies/case_run.hpp"
#include "studies/process_pool.hpp"

namespace ballbot {
namespace {

CaseResult resultOf(const TaskEnd& end) {
  if (end.kind == TaskEnd::Kind::kDone) return CaseResult::fromJson(end.answer);
  CaseResult result;
  const bool crashed = end.kind == TaskEnd::Kind::kCrashed;
  result.outcome = crashed ? CaseOutcome::kCrashed : CaseOutcome::kTimedOut;
  result.reason = crashed ? end.trouble : "took too long";
  return result;
}

MetricRange spreadOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values.front(), 0.5 * (values[(n - 1) / 2] + values[n / 2]), values.back(),
          static_cast<int>(n)};
}

}  // namespace

int SeedSpread::passed() const {
  return static_cast<int>(std::count_if(by_seed.begin(), by_seed.end(), [](const CaseResult& r) {
    return r.outcome == CaseOutcome::kPassed;
  }));
}

std::map<std::string, MetricRange> SeedSpread::metrics() const {
  std::map<std::string, std::vector<double>> values;
  for (const CaseResult& r : by_seed) {
    for (const auto& [name, value] : r.metrics) values[name].push_back(value);
  }
  std::map<std::string, MetricRange> out;
  for (const auto& [name, of_all] : values) out[name] = spreadOf(of_all);
  return out;
}

std::vector<std::string> SeedSpread::missed() const {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < by_seed.size(); ++i) {
    const CaseResult& r = by_seed[i];
    if (r.outcome == CaseOutcome::kPassed) continue;
    out.push_back(
        fmt::format("seed {}: {}", i + 1, r.reason.empty() ? toText(r.outcome) : r.reason));
  }
  return out;
}

std::vector<SeedSpread> runSeeds(const std::vector<std::string>& scenario_files,
                                 const std::vector<std::string>& overrides,
                                 const SeedSpreadOptions& options) {
  std::vector<ConfigNode> trees;
  for (const std::string& file : scenario_files) {
    trees.push_back(loadScenarioTree(file));
    checkScenario(readScenario(trees.back(), overrides, 1));
  }
  const auto seeds = static_cast<std::size_t>(options.seeds);
  const std::size_t count = trees.size() * seeds;
  std::vector<SeedSpread> out(trees.size());
  for (SeedSpread& spread : out) spread.by_seed.resize(seeds);
  std::error_code failed;
  std::filesystem::create_directories(options.scratch, failed);
  if (failed) {
    throw OutputError(fmt::format("{}: cannot be created: {}", options.scratch, failed.message()));
  }

  PoolOptions pool;
  pool.jobs = options.jobs;
  pool.stop = options.stop;
  std::size_t done = 0;
  runInProcesses(
      count,
      [&](std::size_t i) {
        StudyCase c;
        c.id = std::to_string(i);
        c.seed = i % seeds + 1;
        c.overrides = overrides;
        return runCase(trees[i / seeds], c, options.scratch + "/" + c.id, false).toJson();
      },
      pool,
      [&](std::size_t i, const TaskEnd& end) {
        out[i / seeds].by_seed[i % seeds] = resultOf(end);
        if (options.progress) options.progress(++done, count);
      });
  std::filesystem::remove_all(options.scratch, failed);
  return out;
}

}  // namespace ballbot
