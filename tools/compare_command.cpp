#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cosim/log_compare.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"

namespace ballbot {
namespace {

struct CompareArguments {
  std::string a, b;
  bool json = false;
};

nlohmann::ordered_json metricsOf(const RunFolder& folder) {
  try {
    return nlohmann::ordered_json::parse(readTextFile(folder.summaryFile())).at("metrics");
  } catch (const nlohmann::json::exception&) {
    throw InputError(folder.summaryFile() + ": is not a summary; was the run interrupted?");
  }
}

ExitCode compareRuns(const CompareArguments& arguments) {
  const RunFolder a = RunFolder::open(arguments.a), b = RunFolder::open(arguments.b);
  const auto difference = compareLogs(a.logFile(), b.logFile(), RunBegin::kMayBeLater);
  const nlohmann::ordered_json metrics_a = metricsOf(a), metrics_b = metricsOf(b);
  if (arguments.json) {
    nlohmann::ordered_json out;
    out["identical"] = !difference;
    if (difference) {
      out["first_difference"] = {{"tick", difference->tick}, {"time_s", toSeconds(difference->time)},
                                 {"text", difference->text}};
      if (difference->channel) out["first_difference"]["channel"] = channelName(*difference->channel);
    }
    for (const auto& [name, value] : metrics_a.items()) {
      if (metrics_b.contains(name)) out["metrics"][name] = {value, metrics_b[name]};
    }
    fmt::print("{}\n", jsonText(out));
  } else {
    fmt::print("{}\n", difference ? difference->text : "identical");
    fmt::print("{:<32} {:>14} {:>14}\n", "metric", "first", "second");
    for (const auto& [name, value] : metrics_a.items()) {
      if (!metrics_b.contains(name)) continue;
      fmt::print("{:<32} {:>14.6g} {:>14.6g}\n", name, value.get<double>(), metrics_b[name].get<double>());
    }
  }
  return difference ? ExitCode::kRequirementMissed : ExitCode::kPassed;
}

}  // namespace

void addCompareCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand("compare", "Say where two runs differ first, and their metrics");
  const auto a = std::make_shared<CompareArguments>();
  command->add_option("first", a->a, "Run folder")->required();
  command->add_option("second", a->b, "Run folder")->required();
  command->add_flag("--json", a->json, "Print as JSON");
  command->footer(
      "Example:\n  ballbot compare runs/push-001 runs/push-002\n"
      "Exit codes: 0 identical, 1 they differ, 2 bad input.");
  command->callback([&result, a] { result = compareRuns(*a); });
}

}  // namespace ballbot
