#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/key_unit.hpp"
#include "core/number_text.hpp"
#include "cosim/log_reader.hpp"
#include "experiment/estimate_log.hpp"
#include "experiment/estimate_report.hpp"
#include "experiment/recorded_run.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/text_file.hpp"
#include "experiment/verdict.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/table_export.hpp"

namespace ballbot {
namespace {

struct EstimateArguments {
  std::string run, scenario, out;
  std::vector<std::string> overrides;
  bool json = false, no_report = false;
};

struct Sources {
  std::string log, scenario, out;
};

bool sameSettings(const EstimateArguments& a) { return a.overrides.empty() && a.scenario.empty(); }

/// Where an estimate with other settings goes, so that it replaces none.
std::string nextFree(const std::string& run) {
  for (int i = 1;; ++i) {
    std::string path = fmt::format("{}/estimate-{:03}", run, i);
    if (!std::filesystem::exists(path)) return path;
  }
}

/// A run folder holds log and scenario; a log alone needs to be told whose it is.
Sources sourcesOf(const EstimateArguments& a) {
  if (std::filesystem::is_directory(a.run)) {
    const RunFolder folder = RunFolder::open(a.run);
    if (a.scenario.empty()) requireUnedited(folder);
    const std::string out = sameSettings(a) ? folder.path() + "/estimate" : nextFree(folder.path());
    return {folder.logFile(), a.scenario.empty() ? folder.scenarioFile() : a.scenario,
            a.out.empty() ? out : a.out};
  }
  if (a.scenario.empty()) {
    throw InputError(fmt::format(
        "{}: is not a run folder. For a log alone say whose robot and estimator: --scenario FILE",
        a.run));
  }
  return {a.run, a.scenario, a.out.empty() ? a.run + ".estimate" : a.out};
}

nlohmann::ordered_json toJson(const LogEstimate& e) {
  nlohmann::ordered_json out;
  for (const std::string& name : EstimationErrors::names()) {
    const auto it = e.metrics.find(name);  // null where the log says nothing about it
    out[name] =
        it == e.metrics.end() ? nlohmann::ordered_json() : nlohmann::ordered_json(it->second);
  }
  out["rejected"] = nlohmann::ordered_json::object();
  for (const auto& [reason, count] : rejectionsAmong(e.metrics)) out["rejected"][reason] = count;
  out["estimates"] = e.estimates.size();
  out["compared_with_online"] = e.compared;
  out["identical_to_online"] = e.identical();
  if (e.first_difference) out["first_difference_s"] = decimalSeconds(toNs(*e.first_difference));
  return out;
}

std::string onlineText(const LogEstimate& e) {
  if (e.compared == 0) return "the log holds none";
  if (e.identical())
    return fmt::format("identical, {} of {} estimates", e.compared, e.estimates.size());
  return fmt::format("differs from {} on", toText(*e.first_difference));
}

void printTable(const LogEstimate& e, const std::vector<std::string>& files) {
  for (const auto& [name, value] : e.metrics) {
    if (name.rfind("rejected_", 0) == 0) continue;
    fmt::print("  {:<32} {:>12.4g} {}\n", name, value, unitOfKey(name));
  }
  if (!e.has_truth) fmt::print("  the log holds no truth, so there are no errors\n");
  fmt::print("  {:<32} {}\n", "rejected", rejectionText(rejectionsAmong(e.metrics)));
  fmt::print("  {:<32} {}\n", "online estimate", onlineText(e));
  for (const std::string& file : files) fmt::print("  {}\n", file);
}

ExitCode estimateRun(const EstimateArguments& a) {
  const Sources from = sourcesOf(a);
  const RunConfig config = readRunConfig(loadScenario(from.scenario, a.overrides));
  const RunLog log = std::filesystem::is_directory(a.run) ? readRecordedLog(RunFolder::open(a.run))
                                                          : readRunLog(from.log);
  const LogEstimate estimate = estimateLog(config, log);

  RunLog made;
  made.estimates = estimate.estimates;
  std::vector<LogTable> tables = logTables(made);
  tables.push_back(estimate.errors);
  std::vector<std::string> files = exportCsv(tables, from.out);
  files.push_back(from.out + "/estimate.json");
  writeTextFile(files.back(), jsonText(toJson(estimate)) + "\n");
  if (!a.no_report) {
    files.push_back(from.out + "/report.html");
    writeEstimateReport(config, estimate, sameSettings(a), files.back());
  }
  if (a.json) {
    nlohmann::ordered_json out = toJson(estimate);
    out["files"] = files;
    fmt::print("{}\n", jsonText(out));
  } else {
    printTable(estimate, files);
  }
  if (log.cut_off) {
    fmt::print(stderr, "{}: the log ends in the middle of an event; all before it was used\n",
               from.log);
  }
  if (log.damage.none()) return ExitCode::kPassed;
  fmt::print(stderr, "ballbot: {}: {}. What is readable was used\n", from.log, log.damage.text());
  return ExitCode::kBadInput;
}

}  // namespace

void addEstimateCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "estimate",
      "Play a run's recorded sensors to the estimator again; errors, statistics, report");
  const auto a = std::make_shared<EstimateArguments>();
  command->add_option("run", a->run, "Run folder, or an LCM log with the same messages")
      ->required();
  command->add_option("--scenario", a->scenario, "Whose robot and estimator, for a log alone");
  command
      ->add_option("--set", a->overrides,
                   "path=value: another setting, e.g. estimator.iterations=3; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--out", a->out,
                      "Folder for the results (default: RUN/estimate; with --set or --scenario the "
                      "next free RUN/estimate-NNN)");
  command->add_flag("--no-report", a->no_report, "Do not write report.html");
  command->add_flag("--json", a->json, "Print the numbers as JSON");
  command->footer(
      "Examples:\n"
      "  ballbot estimate runs/push-001\n"
      "  ballbot estimate runs/push-001 --set estimator.noise.accel_inflation=1 --json\n"
      "  ballbot estimate bench.lcmlog --scenario configs/scenarios/balance.yaml\n"
      "Exit codes: 0 done, 2 bad input, or the log is damaged (what is readable was used), 4 "
      "output could\n"
      "not be written.");
  command->callback([&result, a] { result = estimateRun(*a); });
}

}  // namespace ballbot
