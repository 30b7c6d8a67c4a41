#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/run_record.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "studies/process_pool.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"
#include "tools/reproduction_figure.hpp"
#include "tools/reproduction_page.hpp"

namespace ballbot {
namespace {

struct ReproduceArguments {
  std::vector<std::string> only, overrides;
  std::string out = "reproduction", scenarios = "configs/scenarios";
  int seeds = 1, jobs = 0;
  bool in_process = false, json = false, quiet = false;
};

/// The experiments to run. @throw InputError naming the known ones.
std::vector<const PaperExperiment*> chosen(const std::vector<std::string>& only) {
  std::vector<const PaperExperiment*> out;
  std::vector<std::string> names;
  for (const PaperExperiment& e : paperExperiments()) {
    names.push_back(e.scenario);
    if (only.empty() || std::find(only.begin(), only.end(), e.scenario) != only.end())
      out.push_back(&e);
  }
  for (const std::string& name : only) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw InputError(fmt::format("--only {}: no such experiment; there are: {}", name,
                                   fmt::join(names, ", ")));
    }
  }
  return out;
}

nlohmann::ordered_json spreadJson(const SeedSpread& spread) {
  nlohmann::ordered_json j;
  j["count"] = spread.by_seed.size();
  j["passed"] = spread.passed();
  j["missed"] = spread.missed();
  for (const auto& [name, m] : spread.metrics()) {
    j["metrics"][name] = {
        {"least", m.least}, {"median", m.median}, {"largest", m.largest}, {"count", m.count}};
  }
  return j;
}

nlohmann::ordered_json toJson(const std::vector<Scenario>& scenarios,
                              const std::vector<ReproducedExperiment>& done,
                              const std::vector<Comparison>& comparisons, bool passed,
                              const std::string& page) {
  nlohmann::ordered_json j;
  j["passed"] = passed;
  j["page"] = page;
  j["experiments"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < done.size(); ++i) {
    nlohmann::ordered_json entry = summaryJson(scenarios[i], *done[i].result);
    entry["run_folder"] = done[i].result->folder.path();
    if (!done[i].spread.by_seed.empty()) entry["seeds"] = spreadJson(done[i].spread);
    j["experiments"].push_back(std::move(entry));
  }
  j["comparisons"] = nlohmann::ordered_json::array();
  for (const Comparison& c : comparisons) {
    j["comparisons"].push_back(
        {{"claim", c.claim}, {"measured", c.measured}, {"passed", c.passed}});
  }
  return j;
}

std::string tableText(const std::vector<ReproducedExperiment>& done,
                      const std::vector<Comparison>& comparisons, const std::string& page) {
  std::string out;
  for (const ReproducedExperiment& e : done) {
    out += fmt::format("{:<32} {:<8} {}\n", e.experiment->scenario,
                       e.result->passed ? "passed" : "MISSED", e.result->trajectory_digest);
    for (const VerdictRow& row : e.result->verdicts) {
      if (row.passed) continue;
      out += fmt::format("  {} is {}, must be {}\n", row.metric,
                         row.measured ? fmt::format("{:.4g}", row.value) : "none", row.limit);
    }
  }
  for (const ReproducedExperiment& e : done) {
    if (e.spread.by_seed.empty()) continue;
    out += fmt::format("{}, seeds 1 to {}: {} passed\n", e.experiment->scenario,
                       e.spread.by_seed.size(), e.spread.passed());
    for (const std::string& line : e.spread.missed()) out += fmt::format("  {}\n", line);
    const auto metrics = e.spread.metrics();
    for (const VerdictRow& row : e.result->verdicts) {
      const auto at = metrics.find(row.metric);
      if (at == metrics.end()) continue;
      const MetricRange& m = at->second;
      out += fmt::format("  {:<32} {:>9.4g} to {:<9.4g} median {:<9.4g} must be {}\n", row.metric,
                         m.least, m.largest, m.median, row.limit);
    }
  }
  for (const Comparison& c : comparisons) {
    out += fmt::format("{}: {}: {}\n", c.passed ? "passed" : "MISSED", c.claim, c.measured);
  }
  return out + fmt::format("page: {}\n", page);
}

/// One for each experiment, or none where one seed is enough.
std::vector<SeedSpread> spreads(const ReproduceArguments& a,
                                const std::vector<const PaperExperiment*>& experiments) {
  if (a.seeds == 1) return std::vector<SeedSpread>(experiments.size());
  std::vector<std::string> files;
  for (const PaperExperiment* e : experiments)
    files.push_back(a.scenarios + "/" + e->scenario + ".yaml");
  Progress progress("seeds", a.quiet);
  SeedSpreadOptions options;
  options.seeds = a.seeds;
  options.jobs = a.jobs > 0 ? a.jobs : processorCount();
  options.scratch = a.out + "/seeds";
  options.stop = interruptFlag();
  options.progress = [&](std::size_t done, std::size_t count) {
    progress.update(static_cast<double>(done) / static_cast<double>(count),
                    fmt::format("{} of {} runs", done, count));
  };
  std::vector<SeedSpread> out = runSeeds(files, a.overrides, options);
  progress.finish();
  return out;
}

ExitCode reproduce(const ReproduceArguments& a) {
  const std::vector<const PaperExperiment*> experiments = chosen(a.only);
  // All are read before the first is run: a mistake in the last should not cost the time of all
  // others.
  std::vector<Scenario> scenarios;
  double total_s = 0;
  for (const PaperExperiment* e : experiments) {
    scenarios.push_back(loadScenario(a.scenarios + "/" + e->scenario + ".yaml", a.overrides));
    total_s += toSeconds(scenarios.back().duration);
  }

  // Before the first run of its own, which starts threads.
  std::vector<SeedSpread> spread = spreads(a, experiments);

  Progress progress("reproduce", a.quiet);
  std::map<std::string, RunResult> results;
  std::vector<ReproducedExperiment> done;
  double done_s = 0;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const Scenario& scenario = scenarios[i];
    RunOptions options;
    options.in_process = a.in_process;
    options.stop = interruptFlag();
    options.progress = [&](SimTime now) {
      if (toNs(now) % 10'000'000 != 0) return;
      progress.update((done_s + toSeconds(now)) / total_s,
                      fmt::format("{} of {}: {} {:.1f} of {:g} s", i + 1, experiments.size(),
                                  scenario.name, toSeconds(now), toSeconds(scenario.duration)));
    };
    const auto [at, inserted] = results.emplace(
        experiments[i]->scenario, runExperiment(scenario, a.out + "/" + scenario.name, options));
    done_s += toSeconds(scenario.duration);
    const RunResult& result = at->second;
    done.push_back({experiments[i], &result,
                    reproductionFigure(scenario, result.folder.logFile(), experiments[i]->panels),
                    scenario.name + "/report.html", std::move(spread[i])});
    writeTextFile(a.out + "/" + scenario.name + ".svg", done.back().figure);
  }
  progress.finish();

  const std::vector<Comparison> comparisons = compareExperiments(results);
  bool passed = true;
  for (const ReproducedExperiment& e : done) {
    passed = passed && e.result->passed &&
             e.spread.passed() == static_cast<int>(e.spread.by_seed.size());
  }
  for (const Comparison& c : comparisons) passed = passed && c.passed;
  const std::string page = a.out + "/index.html";
  writeTextFile(page, reproductionPage(done, comparisons));
  if (a.json) {
    fmt::print("{}\n", jsonText(toJson(scenarios, done, comparisons, passed, page)));
  } else {
    fmt::print("{}", tableText(done, comparisons, page));
  }
  return passed ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

}  // namespace

void addReproduceCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "reproduce", "Repeat the paper's experiments and write one page about them");
  const auto a = std::make_shared<ReproduceArguments>();
  command->add_option("--only", a->only, "Only the experiment of this name; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--out", a->out, "Folder for the page and the run folders")
      ->capture_default_str();
  command->add_option("--scenarios", a->scenarios, "Folder of the scenario files")
      ->capture_default_str();
  command
      ->add_option("--set", a->overrides,
                   "path=value: change one value of every scenario; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command
      ->add_option(
          "--seeds", a->seeds,
          "Also run each with seeds 1 to N: how many pass, and how far their numbers spread")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--jobs", a->jobs, "With --seeds: runs at once (default: one per processor)")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--in-process", a->in_process,
                    "Controller and plant in one process; same bits, no LCM");
  command->add_flag("--json", a->json, "Print verdicts and metrics as JSON");
  command->add_flag("--quiet", a->quiet, "No progress on stderr");
  command->footer(
      "Examples:\n"
      "  ballbot reproduce\n"
      "  ballbot reproduce --only disturbance_ball --only disturbance_ee --out /tmp/pushes --json\n"
      "  ballbot reproduce --seeds 20 --jobs 2 --json\n"
      "Exit codes: 0 all passed, 1 a requirement was missed, 2 bad input, 3 a participant was "
      "lost,\n"
      "4 output could not be written, 130 interrupted.");
  command->callback([&result, a] { result = reproduce(*a); });
}

}  // namespace ballbot
